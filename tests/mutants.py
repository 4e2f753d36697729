#!/usr/bin/env python3
"""mutants.py - do the tests notice when surfmink.h is wrong?

    mutants.py [--jobs N] [--sample N] [--seed N] [--list] [--lines A-B] DIRECTORY [TEST.c ...]

Changes one operator, constant, index or condition of the implementation at a time, compiles each mutant with the test
programs (tcc if there is one, else cc -O0; what survives again with gcc's sanitizers) and runs them until one fails. A
mutant that all pass has survived: a test is missing, or it means the same and belongs into tests/mutants.equivalent
with a reason. Works in DIRECTORY; prints survivors as it finds them, and last `N killed, N survived, N equivalent, N
not compiled`. Exit status 1 if less than 97 % of those that compile and are not equivalent are killed."""

import argparse, concurrent.futures, os, random, re, shutil, subprocess, sys, time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
HEADER = os.path.join(ROOT, 'surfmink.h')
EQUIVALENT = os.path.join(ROOT, 'tests', 'mutants.equivalent')
GOAL = 0.97

# What a token may turn into. Constants and names follow in mutations_of.
SWAPS = {'+': ['-'], '-': ['+'], '*': ['/'], '/': ['*'], '%': ['/'], '<': ['<=', '>='], '<=': ['<', '>'],
         '>': ['>=', '<='], '>=': ['>', '<'], '==': ['!='], '!=': ['=='], '&&': ['||'], '||': ['&&'], '+=': ['-=', '='],
         '-=': ['+=', '='], '*=': ['/=', '='], '/=': ['*=', '='], '++': ['--'], '--': ['++'], '!': ['']}
TOKEN = re.compile(r'/\*.*?\*/|"(?:\\.|[^"\\])*"|[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?'
                   r'|->|\+\+|--|&&|\|\||[-+*/<>=!]=|[-+*/%<>=!?:]|\S', re.S)


def tokens(text):
    return [(m.start(), m.group()) for m in TOKEN.finditer(text) if not m.group().startswith(('/*', '"'))]


def is_declaration_star(found, k):
    """`double *x`, `*x = 0`, `const T *`: a star that multiplies nothing."""
    before = found[k - 1][1] if k else ''
    return not (re.match(r'[\w)\]]', before[-1:]) and before not in
                ('double', 'int', 'void', 'char', 'size_t', 'const', 'return', 'surfmink_surface', 'surfmink__outline',
                 'surfmink__curve', 'surfmink__sum', 'surfmink__block', 'surfmink_functionals', 'float'))


def mutations_of(found, k):
    """Replacements for token k."""
    token, before = found[k][1], found[k - 1][1] if k else ''
    unary = not re.match(r'[\w)\]]', before[-1:]) or before in ('return', 'case')
    if token == '*' and is_declaration_star(found, k): return []
    if token == '-' and unary: return ['']
    if token == '+' and unary: return []
    if re.match(r'\d|\.\d', token):
        if re.fullmatch(r'\d+', token): return [str(int(token) + 1)] + ([str(int(token) - 1)] if int(token) else [])
        return ['(2 * %s)' % token, '(-%s)' % token]
    if token == 'SURFMINK_SIN': return ['SURFMINK_COS']
    if token == 'SURFMINK_COS': return ['SURFMINK_SIN']
    if token in ('surfmink__next', 'surfmink__previous'):
        return [{'surfmink__next': 'surfmink__previous', 'surfmink__previous': 'surfmink__next'}[token]]
    if token == 'continue': return ['break']
    return SWAPS.get(token, [])


def is_definition(lines, number):
    """Prototypes and typedefs say nothing that runs; statements are indented."""
    declaration = re.match(r'\s+(const )?(double|int|size_t|void) [^=(]*;$', lines[number])
    return lines[number].startswith('    ') and not declaration


def all_mutants(text):
    """(line, column, old, new, offset) of every change of the implementation part."""
    start = text.index('#define SURFMINK_IMPLEMENTED')
    end = text.index('#endif /* SURFMINK_IMPLEMENTATION */')
    lines = text.split('\n')
    found = tokens(text)
    mutants = []
    for k, (at, token) in enumerate(found):
        if not start < at < end: continue
        number = text.count('\n', 0, at)
        if not is_definition(lines, number): continue
        column = at - text.rfind('\n', 0, at)
        mutants += [(number + 1, column, token, new, at) for new in mutations_of(found, k)]
    # Whole statements left out, and conditions that are always or never so.
    for number, line in enumerate(lines):
        at = sum(len(l) + 1 for l in lines[:number])
        if not start < at < end or not line.startswith('    '): continue
        statement = re.match(r'(\s+)((?:\*?[\w\[\].>-]+(?: [-+*/]?= |\().*|\+\+.*|--.*);)$', line)
        if statement and not re.match(r'\s+(return|const|double|int|size_t|case)\b', line):
            mutants.append((number + 1, 0, statement.group(2), ';', at + len(statement.group(1))))
        condition = re.match(r'(\s+(?:else )?if )\((.*)\) (return|continue|\w.*;)(.*)$', line)
        if condition and condition.group(2).count('(') == condition.group(2).count(')'):
            for new in ('0', '1'):
                mutants.append((number + 1, 0, condition.group(2), new, at + len(condition.group(1)) + 1))
    return mutants


def describe(mutant, text):
    line, _, old, new, at = mutant
    row = text.split('\n')[line - 1]
    offset = at - (sum(len(l) + 1 for l in text.split('\n')[:line - 1]))
    return (row[:offset] + new + row[offset + len(old):]).strip()


def read_equivalent():
    """Lines `mutated line | reason`: by text and not by number, so that they survive edits elsewhere."""
    if not os.path.exists(EQUIVALENT): return {}
    pairs = [l.rstrip('\n').rsplit(' | ', 1) for l in open(EQUIVALENT) if ' | ' in l and not l.startswith('#')]
    return {mutated.strip(): reason for mutated, reason in pairs}


# The second one only sees what survives the first: writing past an array is no wrong result, but a fault.
FAST = ['tcc'] if shutil.which('tcc') else ['cc', '-O0']
STRICT = ['gcc', '-O1', '-fsanitize=address,undefined', '-fno-sanitize-recover=all']
SLOWER = 8 # the strict one's tests, at most


def run(command, seconds, **more):
    nowhere = subprocess.DEVNULL
    try:
        return subprocess.run(command, timeout=seconds, stdout=nowhere, stderr=nowhere, **more).returncode
    except subprocess.TimeoutExpired:
        return -1


def snapshot(work, tests):
    """Header, tests and what they include, as they are now: nothing that is edited during the run may kill mutants."""
    tree = os.path.join(work, 'tree')
    shutil.rmtree(tree, ignore_errors=True)
    for part in ('examples', 'tests'): shutil.copytree(os.path.join(ROOT, part), os.path.join(tree, part))
    shutil.copy(HEADER, tree)
    tests = tests or sorted(f for f in os.listdir(os.path.join(tree, 'tests')) if re.match(r'test_.*\.c$', f))
    return tree, [os.path.join(tree, 'tests', os.path.basename(test)) for test in tests]


class Worker:
    def __init__(self, work, tree, text, tests, seconds):
        self.work, self.tree, self.text, self.tests, self.seconds = work, tree, text, tests, seconds

    def judge(self, index, mutant):
        """killed by which test, 'survived' or 'not compiled'."""
        place = os.path.join(self.work, 'mutant%d' % index)
        os.makedirs(place, exist_ok=True)
        _, _, old, new, at = mutant
        try:
            with open(os.path.join(place, 'surfmink.h'), 'w') as out:
                out.write(self.text[:at] + new + self.text[at + len(old):])
            for compiler, patience in (FAST, 1), (STRICT, SLOWER):
                for test in self.tests:
                    binary = os.path.join(place, 'test')
                    command = compiler + ['-std=c99', '-I' + place, '-I' + self.tree, test, '-o', binary, '-lm']
                    if run(command, 60, cwd=place): return 'not compiled'
                    if run([binary], patience * self.seconds[test], cwd=self.tree): return os.path.basename(test)
            return 'survived'
        finally:
            shutil.rmtree(place, ignore_errors=True)


def time_tests(work, tree, tests):
    """Tests that pass on the header as it is, the fastest first, each with its time limit."""
    seconds = {}
    for test in tests:
        binary = os.path.join(work, 'unmutated')
        if run(FAST + ['-std=c99', '-I' + tree, test, '-o', binary, '-lm'], 60):
            sys.exit('mutants.py: %s does not compile' % test)
        start = time.time()
        if run([binary], 300, cwd=tree):
            print('left out, for it fails without mutants: %s' % test)
            continue
        seconds[test] = 2 + 4 * (time.time() - start)
    return seconds


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('--jobs', type=int, default=os.cpu_count())
    parser.add_argument('--sample', type=int)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--list', action='store_true')
    parser.add_argument('--lines')
    parser.add_argument('directory')
    parser.add_argument('tests', nargs='*')
    options = parser.parse_args()
    options.directory = os.path.abspath(options.directory)
    os.makedirs(options.directory, exist_ok=True)
    tree, tests = snapshot(options.directory, options.tests)
    text = open(os.path.join(tree, 'surfmink.h')).read()
    mutants = all_mutants(text)
    if options.lines:
        first, last = map(int, options.lines.split('-'))
        mutants = [m for m in mutants if first <= m[0] <= last]
    if options.sample and options.sample < len(mutants):
        mutants = sorted(random.Random(options.seed).sample(mutants, options.sample))
    if options.list:
        for m in mutants: print('%d: %s' % (m[0], describe(m, text)))
        return 0
    equivalent = read_equivalent()
    seconds = time_tests(options.directory, tree, tests)
    worker = Worker(options.directory, tree, text, sorted(seconds, key=seconds.get), seconds)
    killed, survived, excused, broken = {}, [], 0, 0
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for mutant, fate in zip(mutants, pool.map(worker.judge, range(len(mutants)), mutants)):
            if fate == 'not compiled': broken += 1
            elif fate != 'survived': killed[fate] = killed.get(fate, 0) + 1
            elif describe(mutant, text) in equivalent: excused += 1
            else:
                survived.append(mutant)
                print('surfmink.h:%d: survived: %s' % (mutant[0], describe(mutant, text)), flush=True)
    for test in sorted(killed): print('%6d killed by %s' % (killed[test], test))
    total = sum(killed.values())
    print('%d killed, %d survived, %d equivalent, %d not compiled' % (total, len(survived), excused, broken))
    return total < GOAL * (total + len(survived))


if __name__ == '__main__':
    sys.exit(main())

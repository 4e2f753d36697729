#!/usr/bin/env python3
"""mutants.py - do the tests notice when surfmink.h is wrong?

    mutants.py [--jobs N] [--sample N] [--seed N] [--lines A-B] [--again] [--quick] [--list] DIRECTORY

Changes one operator, constant, index, condition or statement of the implementation at a time, compiles each mutant and
runs the tests until one fails. A mutant that all pass has survived: a test is missing, or it means the same and belongs
into tests/mutants.equivalent with a reason. Works in DIRECTORY; prints survivors as it finds them, then a table of the
functions, and last `N killed, N survived, N equivalent, N not compiled`. Exit status 1 if less than 97 % of those that
compile and are not equivalent are killed (of a sample: less than chance allows for), or if tests/mutants.equivalent
lists what is none.

Only the implementation is compiled for each mutant, by tcc, into a library that the tests, compiled once, are run with.
What that leaves alive in the kernels, and what only vectors use, is compiled for SSE2 and runs the tests of batches;
what only AVX2 and AVX-512 use is compiled for those. What is still alive is run with gcc's sanitizers, unless only a
number has changed: writing past an array is no wrong result, but a fault. A theorem is asked only if it runs the line
that was changed, and those first that have killed in the same function. What became of a mutant is remembered in
DIRECTORY by the text of its function and of the theorems, so that after an edit only what it touches is done again;
--again repeats survivors only, --quick leaves out the sanitizers and slow theorems. Lines for other processors and
hints to the cache are not mutated: tests/check.sh runs the tests on arm64. Needs tcc, gcc, addr2line and x86-64 with AVX-512; uses clang if there
is one.
"""

import argparse, concurrent.futures, hashlib, json, os, random, re, resource, shutil, signal, subprocess, sys
import threading, time

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
EQUIVALENT = os.path.join(ROOT, 'tests', 'mutants.equivalent')
GOAL = 0.97

# --- what is changed ------------------------------------------------------------------------------------------------

# What a token may turn into. Constants and names follow in mutations_of.
SWAPS = {'+': ['-'], '-': ['+'], '*': ['/'], '/': ['*'], '%': ['/'], '<': ['<=', '>='], '<=': ['<', '>'],
         '>': ['>=', '<='], '>=': ['>', '<'], '==': ['!='], '!=': ['=='], '&&': ['||'], '||': ['&&'], '+=': ['-=', '='],
         '-=': ['+=', '='], '*=': ['/=', '='], '/=': ['*=', '='], '++': ['--'], '--': ['++'], '!': [''],
         '&': ['|'], '|': ['&'], '^': ['&'], '~': ['']}
NAMES = {'surfmink__next': 'surfmink__previous', 'surfmink__previous': 'surfmink__next', 'SURFMINK__FMA': 'SURFMINK__FNMA', 'SURFMINK__FNMA': 'SURFMINK__FMA',
         'SURFMINK__MIN': 'SURFMINK__MAX', 'SURFMINK__MAX': 'SURFMINK__MIN', 'continue': 'break'}
TOKEN = re.compile(r'/\*.*?\*/|"(?:\\.|[^"\\])*"|[A-Za-z_]\w*|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?'
                   r'|->|\+\+|--|&&|\|\||<<|[-+*/<>=!]=|[-+*/%<>=!?:]|\S', re.S)
TYPES = ('double', 'int', 'void', 'char', 'size_t', 'const', 'return', 'surfmink_surface', 'surfmink_results',
         'surfmink_outline', 'surfmink__polygon', 'surfmink__block', 'surfmink__quad', 'surfmink__fan', 'surfmink__dd',
         'surfmink__sums', 'surfmink__powers', 'surfmink__job', 'surfmink__real', 'surfmink__mask', 'surfmink__pair', 'surfmink_functionals', 'surfmink__measure_window', 'float')
KERNEL_TYPES = ('rows', 'totals', 'ranks', 'group', 'span', 'loaded')


def tokens(text):
    return [(m.start(), m.group()) for m in TOKEN.finditer(text) if not m.group().startswith(('/*', '"'))]


def is_value(found, k):
    """Does an expression end at token k, so that what follows is a binary operator?"""
    before = found[k][1] if k >= 0 else ''
    if before == ')' and found[k - 1][1] in KERNEL_TYPES and found[k - 2][1] == '(': return False # a type
    return bool(re.match(r'[\w)\]]', before[-1:])) and before not in TYPES + ('case',)


def mutations_of(found, k):
    """Replacements for token k."""
    token, binary = found[k][1], is_value(found, k - 1)
    before, after = found[k - 1][1] if k else '', found[k + 1][1] if k + 1 < len(found) else ''
    if token in '*&' and not binary: return []
    if token == '-' and not binary: return ['']
    if token == '+' and not binary: return []
    if re.match(r'\d|\.\d', token):
        if re.fullmatch(r'\d+', token): return [str(int(token) + 1)] + ([str(int(token) - 1)] if int(token) else [])
        return ['(2 * %s)' % token, '(-%s)' % token] if float(token) else ['1.0']
    if before == '[' and after == ']' and re.fullmatch('[a-z_]+', token): return [token + ' + 1']
    if token in NAMES: return [NAMES[token]]
    return SWAPS.get(token, [])


def conditionals(lines):
    """For each line: '' if single calls run it too, 'vector', 'avx', or None if it is not compiled here."""
    where, stack = [], []
    for line in lines:
        directive = re.match(r'#(if|ifdef|ifndef|elif|else|endif)\b *(.*)', line)
        if directive:
            word, condition = directive.groups()
            kind = ''
            if re.search(r'SURFMINK__(INSTANCE|NATIVE) == SURFMINK__(AVX2|AVX512)|DISPATCHES', condition): kind = 'avx'
            elif re.search('NEON|_OPENMP|_WIN32|SURFMINK__GNU_C|__AVX|cplusplus', condition): kind = None
            elif re.search(r'SURFMINK__INSTANCE$|INSTANCE == SURFMINK__SSE2|SURFMINK__NATIVE$', condition): kind = 'vector'
            if word in ('if', 'ifdef', 'ifndef'): stack.append([kind, condition])
            elif word == 'elif': stack[-1] = [kind, condition]
            elif word == 'else':
                stack[-1][0] = '' # without vectors
            elif word == 'endif': stack.pop()
        kinds = [kind for kind, _ in stack if kind != '']
        where.append(None if None in kinds else 'avx' if 'avx' in kinds else 'vector' if kinds else '')
    return where


# Macros that compute something, and numbers that algorithms depend on; the rest are names and codes.
MACRO = re.compile(r'#define SURFMINK__(\w+\([^)]*\)|LANES|WIDTH|COLUMN|SIGN|ROWS|TILES|WINDOW|STRIDE) +(?=\S)')


class Mutant:
    def __init__(self, line, at, old, new): self.line, self.at, self.old, self.new = line, at, old, new


class Header:
    """The text, its functions and all mutants of its implementation."""

    def __init__(self, text):
        self.text, self.lines = text, text.split('\n')
        self.starts = [0]
        for line in self.lines: self.starts.append(self.starts[-1] + len(line) + 1)
        self.first = text.count('\n', 0, text.index('#define SURFMINK_IMPLEMENTED'))
        self.last = text.count('\n', 0, text.rindex('#endif /* SURFMINK_IMPLEMENTATION */'))
        self.where = conditionals(self.lines)
        begin = text.index('#ifdef SURFMINK__INSTANCE')
        self.kernels = (text.count('\n', 0, begin), text.count('\n', 0, text.index('#endif /* SURFMINK__INSTANCE */')))
        self.functions = self.find_functions()
        self.mutants = sorted(self.find_mutants(), key=lambda m: (m.line, m.at, m.old, m.new))

    def find_functions(self):
        """name, first and last line for each line: a function from its name to the closing brace; else the line."""
        found, start = [(line.strip(), k, k) for k, line in enumerate(self.lines)], None
        for k, line in enumerate(self.lines):
            if line == '{':
                start = k
                while not re.match(r'\w.*\(', self.lines[start]): start -= 1
            if line == '}' and start is not None:
                head = ' '.join(self.lines[start:start + 3])
                name = re.search(r'(?:SURFMINK__\((\w+)\)|(surfmink_\w+))\(', head)
                for j in range(start, k + 1): found[j] = (name.group(1) or name.group(2), start, k)
                start = None
        return found

    @staticmethod
    def sizes(line):
        """Where a declaration says how large its arrays are: one more means the same."""
        if not re.match(r'\s+(static )?(const )?(double|int|size_t|surfmink_\w+|SURFMINK__\(\w+\)) ', line): return []
        return [m.span(1) for m in re.finditer(r'[ *]\w+\[([^\[\]]*)\](?=,|;| =)', line)]

    def is_hint(self, number):
        """Does the line only tell the cache what will be read? No result can depend on it."""
        return self.functions[number][0] == 'prefetch' or re.search('prefetch|PREFETCH|ahead', self.lines[number])

    def find_mutants(self):
        heads = set() # parameters
        for _, first, last in set(self.functions):
            while first < last and self.lines[first] != '{':
                heads.add(first)
                first += 1
        found = tokens(self.text)
        for k, (at, token) in enumerate(found):
            number = self.text.count('\n', 0, at)
            if not self.first < number < self.last or self.where[number] is None or self.is_hint(number): continue
            line, column = self.lines[number], at - self.starts[number]
            macro = MACRO.match(line)
            if macro and column < macro.end(): continue
            if not macro and not re.match('    |static const double surfmink__', line): continue
            if re.match(r'\s+(const )?(double|int|size_t|void|surfmink__real) [^=()]*;', line): continue # a declaration
            if re.match(r'\s+(const )?\w+ [^=]*\)?,$', line) and '(' not in line: continue # parameters
            if number in heads or any(a < column + 1 <= b for a, b in self.sizes(line)): continue
            for new in mutations_of(found, k): yield Mutant(number, at, token, new)
        # Whole statements left out, and conditions that are always or never so.
        for number in range(self.first + 1, self.last):
            line, at = self.lines[number], self.starts[number]
            if self.where[number] is None or self.is_hint(number) or not line.startswith('    '): continue
            statement = re.match(r'(\s+)((?:\*?[\w\[\].>-]+(?: [-+*/]?= |\().*|SURFMINK__\(\w+\)\(.*|\+\+.*|--.*);)',
                                 line)
            if statement and not re.match(r'\s+(return|const|double|int|size_t|case|if|for|while)\b', line):
                yield Mutant(number, at + len(statement.group(1)), statement.group(2), ';')
            condition = re.match(r'(\s+(?:} )?(?:else )?if )\((.*)\)( (?:return|continue|\{|\w.*;).*|)$', line)
            if condition and condition.group(2).count('(') == condition.group(2).count(')'):
                for new in '01': yield Mutant(number, at + len(condition.group(1)) + 1, condition.group(2), new)

    def text_of(self, m):
        return self.text[:m.at] + m.new + self.text[m.at + len(m.old):]

    def describe(self, m):
        row, offset = self.lines[m.line], m.at - self.starts[m.line]
        new = '/* not: %s */' % m.old if m.new == ';' else m.new
        changed = row[:offset] + new + row[offset + len(m.old):]
        name, first, last = self.functions[m.line]
        return re.sub(r'\s+', ' ', ('%s: %s' % (name, changed) if first < last else changed)).strip()

    def key(self, m):
        """The same for the same change of the same function, wherever it stands in the file."""
        _, first, last = self.functions[m.line]
        inside = '\n'.join(self.lines[first:last + 1])
        return digest('%d %s %s %s' % (m.at - self.starts[first], m.old, m.new, inside))


def digest(text):
    return hashlib.sha1(text.encode()).hexdigest()[:16]


def read_equivalent():
    """A line `= reason`, below it the mutants it is about: by function and text and not by number, so that they survive
    edits elsewhere."""
    reasons, reason = {}, None
    for line in open(EQUIVALENT):
        line = line.strip()
        if line.startswith('= '): reason = line[2:]
        elif line and not line.startswith('# '): reasons[line] = reason
    return reasons


# --- how it is judged -----------------------------------------------------------------------------------------------

# What harness.h includes: proves the theorems named in MUTANTS_ONLY (all if there is none) and stops at the first that
# fails; says which one it is at, and the time it took. A theorem that is proved again for each instance of the kernels
# is proved for the first one, which is what the public calls choose, unless MUTANTS_ALL is set.
MUTANTS_H = r"""
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
void mutants_covered(const char *name);
#ifndef MUTANTS_COVER
#define mutants_covered(name) (void)(name)
#endif
static int mutants_asks(const char *name)
{
    static const char *seen[1000];
    static int count;
    int k;
    const char *only = getenv("MUTANTS_ONLY"), *at = only ? strstr(only, name) : NULL;
    while (at && !(at[-1] == ' ' && at[strlen(name)] == ' ')) at = strstr(at + 1, name);
    if (only && !at) return 0;
    for (k = 0; k < count && !getenv("MUTANTS_ALL"); ++k)
        if (strcmp(seen[k], name) == 0) return 0;
    seen[count++] = name;
    printf("> %s\n", name);
    fflush(stdout);
    return 1;
}
#undef PROVE
#define PROVE(name) \
    do { \
        clock_t start = clock(); \
        if (!mutants_asks(#name)) break; \
        harness_prove(name, #name); \
        if (harness.failed) exit(1); \
        printf("< %.6f\n", (double)(clock() - start) / CLOCKS_PER_SEC); \
        mutants_covered(#name); \
    } while (0)
"""

# Which blocks of the implementation a theorem runs.
COVER_C = r"""
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
static unsigned char seen[1 << 22];
void __sanitizer_cov_trace_pc(void)
{
    size_t at = (size_t)__builtin_return_address(0) - 0x400000;
    if (at < sizeof seen) seen[at] = 1;
}
void mutants_covered(const char *name)
{
    FILE *out = fopen(getenv("MUTANTS_COVER"), "a");
    size_t at;
    fprintf(out, "%s", name);
    for (at = 0; at < sizeof seen; ++at)
        if (seen[at]) fprintf(out, " %lx", (unsigned long)(at + 0x400000));
    fprintf(out, "\n");
    fclose(out);
    memset(seen, 0, sizeof seen);
}
"""

LIBRARY_C = r"""
#include <math.h>
#if defined(__SSE2__) && defined(__GNUC__) && !defined(SURFMINK_NO_SIMD)
#include <immintrin.h>
#endif
#define SURFMINK_IMPLEMENTATION
#include "surfmink.h"
"""

SANITIZE = ['-fsanitize=address,undefined', '-fno-sanitize-recover=all']
FAST = ['clang' if shutil.which('clang') else 'gcc', '-w', '-O0', '-fgnu89-inline', '-fPIC']
STRICT = ['gcc', '-w', '-O1', '-fgnu89-inline', '-fPIC'] + SANITIZE
STAGES = { # how the implementation is compiled, and the tests
    'plain': (['tcc', '-DSURFMINK_NO_SIMD'], ['gcc', '-O2']),
    'vector': (FAST, ['gcc', '-O2']),
    'avx': (['gcc', '-w', '-O0'], None),
    'strict': (STRICT + ['-DSURFMINK_NO_SIMD'], ['gcc', '-O1'] + SANITIZE),
    'strict vector': (STRICT, ['gcc', '-O1'] + SANITIZE)}
FLAGS = ['-std=c99', '-DFEWER=20']
BATCHES = 'test_batch' # looks inside, and at what only vectors do
VECTORS = [BATCHES]


def run(command, cwd, seconds=None, **environment):
    """Exit status and output; what takes more processor time than it is granted is killed."""
    def limit():
        if seconds: signal.setitimer(signal.ITIMER_PROF, seconds)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    try:
        done = subprocess.run(command, cwd=cwd, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, preexec_fn=limit, env=dict(os.environ, **environment),
                              timeout=20 * seconds + 20 if seconds else 300)
        return done.returncode, done.stdout.decode(errors='replace')
    except subprocess.TimeoutExpired:
        return -1, ''


class Judge:
    def __init__(self, work, header, few, quick):
        self.work, self.header, self.few, self.quick = work, header, few, quick
        self.tree, self.unmutated = os.path.join(work, 'tree'), os.path.join(work, 'unmutated')
        self.lock, self.programs, self.seconds, self.kills, self.covered = threading.Lock(), {}, {}, {}, None
        self.prepared, self.preparing = set(), threading.Lock()
        self.needs = {} # what has to be proved before a theorem that does not stand alone
        self.snapshot()
        if not few: self.cover()
        self.covering = set(t for runs in (self.covered or {}).values() for t in runs) # that run any of the header

    # Header, tests and what they include, as they are now: nothing that is edited during the run may kill.
    def snapshot(self):
        for folder in self.tree, self.unmutated: shutil.rmtree(folder, ignore_errors=True)
        for part in 'examples', 'tests': shutil.copytree(os.path.join(ROOT, part), os.path.join(self.tree, part))
        self.write(os.path.join(self.tree, 'surfmink.h'), self.header.text)
        self.place(self.unmutated, self.header.text)
        self.tests, self.hash, self.common = [], {}, '\n'.join(self.header.lines[:self.header.first])
        for folder in 'tests', 'examples/surfaces':
            for name in sorted(os.listdir(os.path.join(self.tree, folder))):
                if name.endswith('.h'): self.common += open(os.path.join(self.tree, folder, name)).read()
        harness = os.path.join(self.tree, 'tests', 'harness.h')
        text = open(harness).read()
        shown = 'if (harness.failures > HARNESS_SHOWN) return 0;'
        if shown not in text: sys.exit('mutants.py: harness.h has changed')
        self.write(harness, '#include <stdlib.h>\n' + text.replace(shown, 'exit(1);') + '\n#include "mutants.h"\n')
        self.write(os.path.join(self.tree, 'tests', 'mutants.h'), MUTANTS_H)
        self.write(os.path.join(self.tree, 'cover.c'), COVER_C)
        self.write(os.path.join(self.tree, 'inside.h'), self.inside())
        for name in sorted(os.listdir(os.path.join(self.tree, 'tests'))):
            if not re.match(r'test_.*\.c$', name): continue
            path, test = os.path.join(self.tree, 'tests', name), name[:-2]
            text = open(path).read()
            self.tests.append(test)
            theorems = re.findall(r'(?m)^THEOREM\((\w+)\)\n(\{\n(?:.*\n)*?\}\n)', text)
            rest = re.sub(r'(?m)^THEOREM\(\w+\)\n\{\n(?:.*\n)*?\}\n|^ *PROVE.*\n', '', text)
            for theorem, body in theorems: self.hash['%s:%s' % (test, theorem)] = digest(body + rest)
            if 'surfmink__' in text: # as it is for AVX; else linked
                self.write(path.replace('.c', '.whole.c'), text)
                text = text.replace('#include "surfmink.h"', '#include "surfmink.h"\n#include "inside.h"')
            self.write(path, re.sub(r'(?m)^#define SURFMINK_(IMPLEMENTATION|DISPATCH).*', '', text))

    def place(self, folder, text):
        """A header and what is compiled of it."""
        os.makedirs(folder, exist_ok=True)
        # All functions that are private become public, for tests that look inside; what is static in them stays.
        text = re.sub(r'(?m)^(#define SURFMINK__\w+ +)?static ', r'\1', text)
        self.write(os.path.join(folder, 'surfmink.h'), text)
        self.write(os.path.join(folder, 'library.c'), LIBRARY_C)

    def inside(self):
        """Declarations of what test_batch.c uses of the implementation, where it has no vectors."""
        text = ''
        for what in (r'typedef struct surfmink__job \{.*?\} surfmink__job;',
                     r'typedef size_t surfmink__measure_window\(void\);'):
            text += re.search(what, self.header.text, re.S).group() + '\n'
        for what in (r'surfmink__measure_window \*surfmink__choose\(void\)', r'int surfmink__positive\(.*?\)'):
            text += re.search(r'static (%s)\n\{' % what, self.header.text, re.S).group(1) + ';\n'
        found = re.findall(r'static (size_t surfmink__measure_some\(.*?\))\n\{', self.header.text, re.S)
        return text + found[-1] + ';\n'

    @staticmethod
    def write(path, text):
        with open(path, 'w') as out: out.write(text)

    def source(self, test): return os.path.join(self.tree, 'tests', test + '.c')

    def build(self, stage, place):
        """The implementation as a shared library, the header taken from `place`; for AVX the test as a whole."""
        command = STAGES[stage][0] + FLAGS + ['-I' + place, '-I' + self.tree]
        if stage == 'avx':
            command += [self.source(BATCHES + '.whole'), '-o', os.path.join(place, BATCHES), '-lm']
            return not run(command, place)[0]
        return not run(command + ['-shared', os.path.join(place, 'library.c'), '-o',
                                  os.path.join(place, 'libsurfmink.so'), '-lm'], place)[0]

    def prepare(self, stage):
        """Builds the tests of a stage when it is needed first, and times their theorems on the header as it is."""
        with self.preparing:
            if stage in self.prepared: return
            tests = [BATCHES] if stage == 'avx' else VECTORS if 'vector' in stage else self.tests
            compiler = ['tcc'] if self.few and stage == 'plain' else STAGES[stage][1]
            if not self.build(stage, self.unmutated): sys.exit('mutants.py: surfmink.h does not compile (%s)' % stage)
            for test in tests if compiler else []:
                kind = digest(' '.join(compiler) + open(self.source(test)).read() + self.common + MUTANTS_H)
                self.programs[stage, test] = os.path.join(self.work, '%s.%s' % (test, kind))
                if not os.path.exists(self.programs[stage, test]):
                    command = compiler + FLAGS + ['-I' + self.tree, self.source(test), '-o', self.programs[stage, test],
                                                  '-L' + self.unmutated, '-lsurfmink', '-lm']
                    if run(command, self.work)[0]: sys.exit('mutants.py: %s does not compile' % test)
            key = digest(self.header.text + self.common + str((self.hash, compiler, STAGES[stage], self.few)))
            path = os.path.join(self.work, 'times.%s.json' % key)
            if not os.path.exists(path): self.write(path, json.dumps(self.time_theorems(stage, tests)))
            seconds, needs = json.load(open(path))
            self.needs.update(needs)
            for name in seconds: self.seconds[stage, name] = seconds[name]
            self.prepared.add(stage)

    def time_theorems(self, stage, tests):
        """Seconds of each, and what has to be proved before those that do not stand alone."""
        seconds, needs = {}, {}
        for test in tests:
            status, said = self.ask(stage, test, None, self.unmutated)
            if status < 0 and self.few: continue # it takes too long
            if status:
                print('left out, for it fails without mutants: %s (%s)' % (test, stage), flush=True)
                continue
            before = []
            for theorem, time_taken in re.findall(r'> (\w+)\n(?:[^<>].*\n)*?< ([\d.]+)', said):
                name = '%s:%s' % (test, theorem)
                self.seconds[stage, name] = seconds[name] = seconds.get(name, 0) + float(time_taken)
                if stage == 'plain' and (self.few or not self.stands_alone(test, name)): needs[name] = before[:]
                before.append(name)
        return seconds, needs

    def stands_alone(self, test, name):
        """Does a theorem hold without those before it? (Some share what is expensive.) Remembered by its text."""
        known = os.path.join(self.work, 'alone.%s.%s' % (name.replace(':', '.'), self.hash[name]))
        if not os.path.exists(known): self.write(known, str(self.ask('plain', test, [name], self.unmutated)[0]))
        return open(known).read() == '0'

    def ask(self, stage, test, theorems, place):
        """Runs theorems of a test, all if None, with the implementation in `place`."""
        program = os.path.join(place, BATCHES) if stage == 'avx' else self.programs[stage, test]
        more = {'LD_LIBRARY_PATH': place, 'ASAN_OPTIONS': 'detect_leaks=0'}
        if stage == 'avx': more['MUTANTS_ALL'] = '1'
        if theorems is None: return run([program], self.tree, 8 if self.few and stage != 'avx' else 300, **more)
        theorems = [t for needed in theorems for t in self.needs.get(needed, []) + [needed]]
        more['MUTANTS_ONLY'] = ' %s ' % ' '.join(t.split(':')[1] for t in theorems)
        return run([program], self.tree, 0.3 + 4 * sum(self.seconds.get((stage, t), 0) for t in theorems), **more)

    def cover(self):
        """Which theorems run which blocks, each named by the line it begins with; kept by what it depends on."""
        path = os.path.join(self.work, 'covered.%s.json' % digest(self.header.text + self.common + str(self.hash)))
        if os.path.exists(path):
            self.covered = json.load(open(path))
            return
        at, self.covered = {}, {}
        place = os.path.join(self.work, 'cover')
        os.makedirs(place, exist_ok=True)
        library, cover = os.path.join(place, 'library.o'), os.path.join(place, 'cover.o')
        run(['gcc', '-w', '-O0', '-g', '-fgnu89-inline', '-fno-pie', '-fsanitize-coverage=trace-pc', '-std=c99',
             '-DSURFMINK_NO_SIMD', '-I' + self.tree, '-c', os.path.join(self.unmutated, 'library.c'), '-o',
             library], place)
        run(['gcc', '-O2', '-fno-pie', '-c', os.path.join(self.tree, 'cover.c'), '-o', cover], place)
        for test in self.tests:
            program, log = os.path.join(place, test), os.path.join(place, test + '.log')
            if os.path.exists(log): os.remove(log)
            if run(['gcc', '-w', '-O1', '-no-pie', '-DMUTANTS_COVER'] + FLAGS + ['-I' + self.tree, self.source(test),
                    library, cover, '-o', program, '-lm'], place)[0]: sys.exit('mutants.py: no coverage of ' + test)
            run([program], self.tree, 600, MUTANTS_COVER=log)
            ran = [line.split() for line in open(log)]
            places = sorted(set(pc for row in ran for pc in row[1:]))
            said = subprocess.run(['addr2line', '-e', program], input='\n'.join(places), stdout=subprocess.PIPE,
                                  universal_newlines=True).stdout.split('\n')
            for pc, line in zip(places, said):
                found = re.search(r'surfmink\.h:(\d+)', line)
                at[pc] = int(found.group(1)) - 1 if found else None
            for row in ran:
                for line in set(at[pc] for pc in row[1:]) - {None}:
                    self.covered.setdefault(str(line), []).append('%s:%s' % (test, row[0]))
        self.write(path, json.dumps(self.covered))

    def candidates(self, m, stage, known):
        """Groups of theorems that run the block, each group of one test: those that have killed in the same function
        one by one, then the rest, quick ones first."""
        theorems = [t for s, t in list(self.seconds) if s == stage]
        if self.covered: theorems = [t for t in theorems if t in self.covering]
        if stage == 'strict': theorems = [t for t in theorems if self.seconds['plain', t] < 0.3]
        if self.quick: theorems = [t for t in theorems if self.seconds[stage, t] < 0.2]
        name, first, last = self.header.functions[m.line]
        if self.covered and stage in ('plain', 'strict') and first < last:
            line = m.line
            while line >= first and str(line) not in self.covered: line -= 1
            runs = set(self.covered.get(str(line), []) if line >= first else [])
            theorems = [t for t in theorems if t in runs]
        kills, cost = self.kills.get(name, {}), lambda t: self.seconds[stage, t] + 0.01
        theorems.sort(key=lambda t: (t != known, -kills.get(t, 0) / cost(t)))
        alone = [t for t in theorems[:4] if kills.get(t) or t == known]
        groups = {}
        for t in theorems:
            if t not in alone: groups.setdefault((t.split(':')[0], int(10 * self.seconds[stage, t])), []).append(t)
        return [[t] for t in alone] + sorted(groups.values(), key=lambda g: sum(map(cost, g)))

    def stages(self, m):
        where = self.header.where[m.line]
        kernel = self.header.kernels[0] <= m.line <= self.header.kernels[1]
        stages = ['plain'] if where == '' else []
        if where != '' or kernel: stages.append('avx' if where == 'avx' else 'vector')
        number = re.search(r'\d[.]|SIN|COS', m.old) or m.old in ('<', '>', '<=', '>=') and m.new.startswith(m.old)
        if where != 'avx' and not number and not self.quick: stages.append('strict vector' if kernel else 'strict')
        return stages

    def judge(self, m, remembered):
        """{'fate': theorem that killed it, 'survived' or 'not compiled', ...}"""
        passed = set(remembered.get('passed', [])) if remembered.get('fate') == 'survived' else set()
        place = os.path.join(self.work, 'mutant.%s' % self.header.key(m))
        name = self.header.functions[m.line][0]
        try:
            self.place(place, self.header.text_of(m))
            for stage in self.stages(m):
                self.prepare(stage)
                built = False
                for group in self.candidates(m, stage, remembered.get('fate')):
                    marks = ['%s %s %s' % (stage, t, self.hash[t]) for t in group]
                    if all(mark in passed for mark in marks): continue
                    if not built and not self.build(stage, place): return {'fate': 'not compiled'}
                    built = True
                    test = group[0].split(':')[0]
                    status, said = self.ask(stage, test, group, place)
                    if status:
                        at = re.findall(r'> (\w+)\n', said)
                        killer = '%s:%s' % (test, at[-1]) if at else group[0]
                        with self.lock:
                            kills = self.kills.setdefault(name, {})
                            kills[killer] = kills.get(killer, 0) + 1
                        return {'fate': killer, 'stage': stage, 'hash': self.hash[killer]}
                    passed.update(marks)
            return {'fate': 'survived', 'passed': sorted(passed)}
        finally:
            shutil.rmtree(place, ignore_errors=True)

    def holds(self, remembered):
        """Is what became of it last time what would become of it now?"""
        fate = remembered.get('fate')
        return fate == 'not compiled' or fate in self.hash and remembered['hash'] == self.hash[fate]


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument('--jobs', type=int, default=1)
    parser.add_argument('--sample', type=int)
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--list', action='store_true')
    parser.add_argument('--again', action='store_true')
    parser.add_argument('--quick', action='store_true')
    parser.add_argument('--lines')
    parser.add_argument('directory')
    options = parser.parse_args()
    work = os.path.abspath(options.directory)
    os.makedirs(work, exist_ok=True)
    header = Header(open(os.path.join(ROOT, 'surfmink.h')).read())
    mutants, whole = header.mutants, True
    memory = os.path.join(work, 'memory.json')
    fates = json.load(open(memory)) if os.path.exists(memory) else {}
    if options.lines:
        first, last = map(int, options.lines.split('-'))
        mutants, whole = [m for m in mutants if first <= m.line + 1 <= last], False
    if options.again:
        mutants, whole = [m for m in mutants if fates.get(header.key(m), {}).get('fate') == 'survived'], False
    if options.sample and options.sample < len(mutants):
        mutants, whole = random.Random(options.seed).sample(mutants, options.sample), False
    if options.list:
        for m in mutants: print('%d: %s' % (m.line + 1, header.describe(m)))
        print('%d mutants' % len(mutants))
        return 0
    # In random order, so that the figures of the first thousand are those of all, but for chance.
    mutants = random.Random(options.seed).sample(mutants, len(mutants))
    judge = Judge(work, header, len(mutants) < 100 and not options.again, options.quick)
    for m in header.mutants:
        fate = fates.get(header.key(m), {}).get('fate')
        if fate not in (None, 'survived', 'not compiled'):
            kills = judge.kills.setdefault(header.functions[m.line][0], {})
            kills[fate] = kills.get(fate, 0) + 1
    reasons, used, wrong = read_equivalent(), set(), []
    table, count = {}, {'killed': 0, 'survived': 0, 'equivalent': 0, 'not compiled': 0}

    def one(m):
        remembered = fates.get(header.key(m), {})
        return remembered if judge.holds(remembered) else judge.judge(m, remembered)

    started = time.time()
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done, (m, fate) in enumerate(zip(mutants, pool.map(one, mutants))):
            fates[header.key(m)] = fate
            said = header.describe(m)
            what = fate['fate'] if fate['fate'] in ('survived', 'not compiled') else 'killed'
            if said in reasons:
                used.add(said)
                if what == 'survived': what = 'equivalent'
                elif what == 'killed': wrong.append('%s (killed by %s)' % (said, fate['fate']))
            if what == 'survived': print('surfmink.h:%d: survived: %s' % (m.line + 1, said), flush=True)
            count[what] += 1
            row = table.setdefault(header.functions[m.line][0] if header.functions[m.line][1] <
                                   header.functions[m.line][2] else '(macros, constants)', dict.fromkeys(count, 0))
            row[what] += 1
            if done % 20 == 19:
                print('# %d of %d, %.0f s, line %d: %s' % (done + 1, len(mutants), time.time() - started, m.line + 1,
                                                           count), flush=True)
                with open(memory, 'w') as out: json.dump(fates, out)
    with open(memory, 'w') as out: json.dump(fates, out)
    print('   killed  survived  equivalent  not compiled')
    for name, row in sorted(table.items()): print('%9d %9d %11d %13d  %s' % (*row.values(), name))
    if whole: wrong += ['%s (no such mutant)' % said for said in reasons if said not in used]
    for said in wrong: print('tests/mutants.equivalent: is none: %s' % said)
    print('%(killed)d killed, %(survived)d survived, %(equivalent)d equivalent, %(not compiled)d not compiled' % count)
    judged = count['killed'] + count['survived']
    chance = 2 * (judged * GOAL * (1 - GOAL)) ** 0.5 if options.sample else 0 # what a sample may be off by
    return bool(wrong) or count['killed'] < GOAL * judged - chance


if __name__ == '__main__':
    sys.exit(main())

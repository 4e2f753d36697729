#!/usr/bin/env python3
"""coverage.py DIRECTORY TEST.c ... - which lines and branches of surfmink.h no test has taken.

Compiles each test with gcc --coverage, runs it, and merges what gcov says: a line is covered if a test runs it, a
branch if a test takes it. The kernels are compiled once for each set of vector instructions: their lines
count once, and so do branches where the instances have the same ones on a line. Nothing is inlined, so that
a function is counted once and not wherever it is called. Prints a table of the functions, then every line and branch
that is missing; the last line is the total. Exit status 1 if there are any. The tests have to pass."""

import gzip, json, os, re, subprocess, sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
INSTANCE = re.compile('_(sse2|avx2|avx512|neon)$')


def measure(work, test):
    """What gcov says of surfmink.h after one test."""
    binary = os.path.splitext(os.path.basename(test))[0]
    source = os.path.abspath(test)
    for left in ('.gcda', '.gcno'):
        for name in os.listdir(work):
            if name.startswith(binary) and name.endswith(left): os.remove(os.path.join(work, name))
    compiler = ['gcc', '-w', '-std=c99', '-O0', '--coverage', '-DFEWER=20', '-Dalways_inline=__noinline__', '-I' + ROOT]
    subprocess.run(compiler + [source, '-o', binary, '-lm'], cwd=work, check=True)
    # what a test counts goes to where it was compiled, so that it may run at the root
    if subprocess.run([os.path.join(work, binary)], cwd=ROOT, stdout=subprocess.DEVNULL).returncode:
        sys.exit('coverage.py: %s fails' % test)
    notes = [f for f in os.listdir(work) if f.startswith(binary) and f.endswith('.gcno')]
    subprocess.run(['gcov', '--json-format', '--branch-probabilities'] + notes, cwd=work, check=True,
                   stdout=subprocess.DEVNULL)
    found = []
    for name in os.listdir(work):
        if not name.endswith('.gcov.json.gz'): continue
        with gzip.open(os.path.join(work, name)) as file: report = json.load(file)
        os.remove(os.path.join(work, name))
        found += [f for f in report['files'] if os.path.basename(f['file']) == 'surfmink.h']
    return found


def common(name):
    """One name for all instances of a kernel."""
    return INSTANCE.sub('', name)


def main():
    work, tests = os.path.abspath(sys.argv[1]), sys.argv[2:]
    os.makedirs(work, exist_ok=True)
    functions, lines, branches = {}, {}, {}
    for test in tests:
        for report in measure(work, test):
            for f in report['functions']: functions[common(f['name'])] = f['start_line']
            for line in report['lines']:
                place = (common(line['function_name']), line['line_number'])
                lines[place] = lines.get(place, 0) + line['count']
                for k, branch in enumerate(line['branches']):
                    way = (place, '%d of %d' % (k, len(line['branches'])))
                    branches[way] = branches.get(way, 0) + branch['count']
    text = open(os.path.join(ROOT, 'surfmink.h')).read().split('\n')
    print('%9s %12s  function' % ('lines', 'branches'))
    for name in sorted(functions, key=lambda f: (functions[f], f)):
        mine = [c for (f, _), c in lines.items() if f == name]
        ways = [c for ((f, _), _), c in branches.items() if f == name]
        taken = (sum(c > 0 for c in mine), len(mine), sum(c > 0 for c in ways), len(ways))
        print('%4d/%-4d %6d/%-5d  %s%s' % (taken + (name, '' if all(mine) and all(ways) else '  <')))
    missing = [(n, name, 'never run') for (name, n), c in lines.items() if not c]
    missing += [(place[1], place[0], 'branch %s never taken' % k) for (place, k), c in branches.items()
                if not c and lines[place]]
    for number, name, what in sorted(missing):
        print('surfmink.h:%d: %s: %s: %s' % (number, name, what, text[number - 1].strip()))
    print('%d of %d lines, %d of %d branches' % (sum(c > 0 for c in lines.values()), len(lines),
                                                  sum(c > 0 for c in branches.values()), len(branches)))
    return bool(missing)


if __name__ == '__main__':
    sys.exit(main())

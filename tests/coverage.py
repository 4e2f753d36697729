#!/usr/bin/env python3
"""coverage.py DIRECTORY TEST.c ... - which lines and branches of surfmink.h no test has taken.

Compiles each test with gcc --coverage, runs it, and merges what gcov says: a line is covered if a test runs it, a
branch if a test takes it. Prints a table of the functions, then every line and branch that is missing; the last line is
the total. Exit status 1 if there are any. The tests have to pass."""

import gzip, json, os, subprocess, sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def measure(work, test):
    """What gcov says of surfmink.h after one test."""
    binary = os.path.splitext(os.path.basename(test))[0]
    source = os.path.abspath(test)
    for left in ('.gcda', '.gcno'):
        for name in os.listdir(work):
            if name.startswith(binary) and name.endswith(left): os.remove(os.path.join(work, name))
    compiler = ['gcc', '-std=c99', '-O0', '--coverage', '-I' + ROOT]
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


def main():
    work, tests = os.path.abspath(sys.argv[1]), sys.argv[2:]
    os.makedirs(work, exist_ok=True)
    functions, lines, branches = {}, {}, {}
    for test in tests:
        for report in measure(work, test):
            for f in report['functions']: functions[f['name']] = (f['start_line'], f['end_line'])
            for line in report['lines']:
                number = line['line_number']
                lines[number] = lines.get(number, 0) + line['count']
                for k, branch in enumerate(line['branches']):
                    branches[number, k] = branches.get((number, k), 0) + branch['count']
    text = open(os.path.join(ROOT, 'surfmink.h')).read().split('\n')
    print('%9s %12s  function' % ('lines', 'branches'))
    for name, (first, last) in sorted(functions.items(), key=lambda item: item[1]):
        mine = [c for n, c in lines.items() if first <= n <= last]
        ways = [c for (n, _), c in branches.items() if first <= n <= last]
        taken = (sum(c > 0 for c in mine), len(mine), sum(c > 0 for c in ways), len(ways))
        print('%4d/%-4d %6d/%-5d  %s%s' % (taken + (name, '' if all(mine) and all(ways) else '  <')))
    missing = sorted([(n, 'never run') for n, c in lines.items() if not c] +
                     [(n, 'branch %d never taken' % k) for (n, k), c in branches.items() if not c and lines[n]])
    for number, what in missing: print('surfmink.h:%d: %s: %s' % (number, what, text[number - 1].strip()))
    print('%d of %d lines, %d of %d branches' % (sum(c > 0 for c in lines.values()), len(lines),
                                                  sum(c > 0 for c in branches.values()), len(branches)))
    return bool(missing)


if __name__ == '__main__':
    sys.exit(main())

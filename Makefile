# surfmink is one header: copy surfmink.h, there is nothing to build. This file builds what stands around it.
#
#   make            the commands: surfmink levelset outlines patic tissue relax, in .build/
#   make demo       measures countries, the H3 grid, a tissue and an image; pictures in .build/demo/
#   make paper      the experiments of the paper, computed beside printed; pictures and tables in .build/paper/
#   make pictures   the pictures of docs/internals/theory.md, and the numbers behind them, in .build/pictures/
#   make playground  docs/playground.html, a page to play with; needs clang and lld
#   make reference  docs/reference.md, from the comments of surfmink.h
#   make test       all tests; needs cc and make, nothing else; EFFORT=10 for ten times as many seeds
#   make check      compilers, dialects, machines, static analysis, sanitizers; needs what .ci/run installs; JOBS=2
#   make accuracy   worst errors over random polygons, against quadruple precision; needs gcc; POLYGONS=1000000
#   make bench      ns a corner, beside other ways to the same numbers; gcc, clang; 25 minutes, BENCH=--quick: 7
#   make bench-count  instructions a corner of the same ways, and of smooth curves; needs gcc, valgrind and x86-64
#   make fuzz       every public function and reader under clang's libFuzzer; SECONDS=60 for each
#   make coverage   lines and branches of surfmink.h that no test takes; needs gcc, gcov, python3
#   make mutants    do the tests notice a broken surfmink.h? hours; needs tcc, gcc, python3; MUTANTS=--sample=200
#   make shared     .build/libsurfmink.so, for other languages: docs/languages.md
#   make install-shared  the same, to PREFIX/lib; make uninstall-shared removes it
#   make install    header, pkg-config and CMake files, commands, man pages; PREFIX=/usr/local, DESTDIR= for packagers
#   make uninstall  removes what make install with the same PREFIX and DESTDIR put there
#   make clean      removes .build/, where everything goes
#
# CC, CFLAGS and LDFLAGS are yours to set.  (GNU make)

CC ?= cc
CFLAGS ?= -O2
PREFIX ?= /usr/local
LDLIBS = -lm
BUILD = .build
VERSION := $(shell sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)

# The library that make shared builds. Before 1.0 the second number of the version may change what programs rely on.
ABI := $(if $(filter 0.%,$(VERSION)),$(basename $(VERSION)),$(firstword $(subst ., ,$(VERSION))))
ifeq ($(shell uname -s),Darwin)
library = libsurfmink.$(VERSION).dylib
library_abi = libsurfmink.$(ABI).dylib
library_link = libsurfmink.dylib
LIBRARY_FLAGS = -dynamiclib -Wl,-install_name,$(PREFIX)/lib/$(library_abi)
else
library = libsurfmink.so.$(VERSION)
library_abi = libsurfmink.so.$(ABI)
library_link = libsurfmink.so
LIBRARY_FLAGS = -shared -Wl,-soname,$(library_abi)
endif

commands = surfmink levelset outlines patic tissue relax
experiments = $(patsubst examples/paper/%.c,$(BUILD)/paper_%,$(wildcard examples/paper/*.c))
theories = $(patsubst examples/theory/%.c,$(BUILD)/theory_%,$(wildcard examples/theory/*.c))
theorems = $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/test_*.c))
headers = surfmink.h $(wildcard examples/*.h examples/*/*.h tests/*.h)

harnesses = $(notdir $(basename $(wildcard tests/fuzz/*.c)))
POLYGONS = 1000000
SECONDS = 60
MUTANTS =
BENCH =
FUZZ = -DFUZZ_WITH_LIBFUZZER -fsanitize=fuzzer,address,undefined,float-divide-by-zero,float-cast-overflow,integer \
       -fsanitize-ignorelist=tests/fuzz/wraps -fno-sanitize-recover=all

all: $(addprefix $(BUILD)/,$(commands))

# The implementation is compiled once for all programs but the test that looks inside.
$(BUILD)/surfmink.o: surfmink.h
	@mkdir -p $(@D)
	$(CC) -std=c99 -DSURFMINK_IMPLEMENTATION $(CPPFLAGS) -I. $(CFLAGS) -x c -c $< -o $@

$(BUILD)/%: examples/%.c $(BUILD)/surfmink.o $(headers)
	@mkdir -p $(@D)
	$(CC) -std=c99 -DSURFMINK_IMPLEMENTED $(CPPFLAGS) -I. $(CFLAGS) $< $(BUILD)/surfmink.o -o $@ $(LDFLAGS) $(LDLIBS)

# Tests are compiled with -O1 unless CFLAGS are given: that takes half the time, and they run as long.
test_cflags := $(if $(filter file,$(origin CFLAGS)),-O1,$(CFLAGS))
$(BUILD)/test_%: tests/test_%.c $(BUILD)/surfmink.o $(headers)
	$(CC) -std=c99 -DSURFMINK_IMPLEMENTED $(CPPFLAGS) -I. $(test_cflags) $< $(BUILD)/surfmink.o -o $@ $(LDFLAGS) $(LDLIBS)

$(BUILD)/test_batch: $(BUILD)/%: tests/%.c $(headers)
	@mkdir -p $(@D)
	$(CC) -std=c99 $(CPPFLAGS) -I. $(CFLAGS) $< -o $@ $(LDFLAGS) $(LDLIBS)

$(BUILD)/paper_%: examples/paper/%.c $(BUILD)/surfmink.o $(headers)
	$(CC) -std=c99 -DSURFMINK_IMPLEMENTED $(CPPFLAGS) -I. $(CFLAGS) $< $(BUILD)/surfmink.o -o $@ $(LDFLAGS) $(LDLIBS)

$(BUILD)/theory_%: examples/theory/%.c $(BUILD)/surfmink.o $(headers)
	$(CC) -std=c99 -DSURFMINK_IMPLEMENTED $(CPPFLAGS) -I. $(CFLAGS) $< $(BUILD)/surfmink.o -o $@ $(LDFLAGS) $(LDLIBS)

shared: $(BUILD)/$(library)

$(BUILD)/$(library): examples/languages/flat.c examples/languages/flat.h surfmink.h $(wildcard examples/beyond/*.h)
	@mkdir -p $(@D)
	$(CC) -std=c99 $(CPPFLAGS) -I. $(CFLAGS) -fPIC -fvisibility=hidden \
	  '-DSURFMINK_DEF=__attribute__((visibility("default"))) extern' $(LIBRARY_FLAGS) $< -o $@ $(LDFLAGS) $(LDLIBS)
	ln -sf $(library) $(BUILD)/$(library_abi)
	ln -sf $(library_abi) $(BUILD)/$(library_link)

demo: $(BUILD)/surfmink $(BUILD)/outlines $(BUILD)/patic $(BUILD)/image/rasterise
	@sh examples/demo.sh $(BUILD)/surfmink $(BUILD)/demo

paper: $(experiments)
	@mkdir -p $(BUILD)/paper
	@status=0; for experiment in $(experiments); do $$experiment $(BUILD)/paper || status=1; done; exit $$status

pictures: $(theories)
	@mkdir -p $(BUILD)/pictures
	@status=0; for theory in $(theories); do $$theory $(BUILD)/pictures || status=1; echo; done; exit $$status

$(BUILD)/playground.html: surfmink.h $(wildcard examples/playground/* examples/playground/*/* examples/surfaces/*)
	@mkdir -p $(@D)
	clang --target=wasm32 -std=c99 -O2 -ffreestanding -fno-math-errno -mbulk-memory -nostdlibinc -nostdlib -I. \
	  -isystem examples/playground/freestanding -Wl,--no-entry -Wl,--strip-all -Wl,-z,stack-size=131072 \
	  examples/playground/playground.c -o $(@D)/playground.wasm
	base64 -w 120 $(@D)/playground.wasm > $(@D)/playground.base64
	sh examples/playground/build.sh $(@D)/playground.base64 > $@.new
	mv $@.new $@

playground: $(BUILD)/playground.html
	cp $(BUILD)/playground.html docs/playground.html

reference:
	awk -f tests/reference.awk surfmink.h > docs/reference.md

# a test runs make install
this_make := $(MAKE)

test: all $(theorems) $(theories) $(BUILD)/image/rasterise
	@sh tests/run.sh $(BUILD)/test.total $(theorems) \
	  "sh tests/test_command.sh $(BUILD)/surfmink" \
	  "sh tests/test_pictures.sh $(BUILD)/surfmink" \
	  "sh tests/test_levelset.sh $(BUILD)/levelset $(BUILD)/surfmink" \
	  "sh tests/test_patic.sh $(BUILD)/patic $(BUILD)/surfmink" \
	  "sh tests/test_outlines.sh $(BUILD)" \
	  "sh tests/test_relax.sh $(BUILD)/relax $(BUILD)/tissue $(BUILD)/surfmink" \
	  "sh tests/test_abuse.sh $(BUILD)" \
	  "sh tests/test_scaling.sh $(BUILD)/surfmink" \
	  "sh tests/test_fuzzed.sh" \
	  "sh tests/test_playground.sh" \
	  "sh tests/test_docs.sh $(BUILD) '$(CC)'" \
	  "sh tests/test_install.sh $(BUILD) '$(CC)' '$(this_make)'" \
	  "sh tests/test_manual.sh $(BUILD)" \
	  "sh tests/test_links.sh"

accuracy:
	@mkdir -p $(BUILD)
	gcc -O2 -I. tests/accuracy/kernels.c -o $(BUILD)/kernels -lquadmath -lm
	$(BUILD)/kernels
	gcc -O2 -I. tests/accuracy/accuracy.c -o $(BUILD)/accuracy -lquadmath -lm
	$(BUILD)/accuracy --polygons $(POLYGONS)
	gcc -O2 -I. tests/accuracy/curve.c -o $(BUILD)/accuracy_curve -lquadmath -lm
	$(BUILD)/accuracy_curve 200

bench:
	@mkdir -p $(BUILD)
	@for cc in gcc clang; do \
	  command -v $$cc > /dev/null || continue; \
	  openmp=' -fopenmp'; \
	  echo '#include <omp.h>' | $$cc -fopenmp -shared -x c - -o $(BUILD)/bench 2> /dev/null || openmp=; \
	  for flags in '-O2' '-O2 -DSURFMINK_DISPATCH' '-O3 -march=native'; do \
	    $$cc -std=c99 $$flags$$openmp -DBENCH_FLAGS="\"$$flags$$openmp\"" -I. tests/bench/bench.c \
	      -o $(BUILD)/bench -lm && \
	    KMP_BLOCKTIME=1 GOMP_SPINCOUNT=10000 $(BUILD)/bench $(BENCH) || exit 1; done; done

bench-count:
	@mkdir -p $(BUILD)
	@gcc -std=c99 -O2 -I. tests/bench/bench.c -o $(BUILD)/bench_x86-64 -lm
	@gcc -std=c99 -O2 -march=haswell -I. tests/bench/bench.c -o $(BUILD)/bench_haswell -lm
	@sh tests/bench/count.sh $(BUILD)/bench_x86-64 $(BUILD)/bench_haswell
	@gcc -std=c99 -O2 -I. tests/bench/curve.c -o $(BUILD)/bench_curve -lm
	@sh tests/bench/count_curve.sh $(BUILD)/bench_curve

fuzz:
	@mkdir -p $(BUILD)/fuzz
	@for harness in $(harnesses); do \
	  echo "$$harness"; mkdir -p $(BUILD)/fuzz/$$harness.found && \
	  clang -std=c99 -g -O1 $(FUZZ) -I. tests/fuzz/$$harness.c -o $(BUILD)/fuzz/$$harness -lm && \
	  { $(BUILD)/fuzz/$$harness -max_total_time=$(SECONDS) -artifact_prefix=$(BUILD)/fuzz/ \
	      $(BUILD)/fuzz/$$harness.found tests/fuzz/corpus/$$harness > $(BUILD)/fuzz/$$harness.log 2>&1 || \
	    { tail -n 40 $(BUILD)/fuzz/$$harness.log; exit 1; }; } || exit 1; done

coverage:
	@mkdir -p $(BUILD)/coverage
	python3 tests/coverage.py $(BUILD)/coverage $(filter-out %test_mesh.c,$(wildcard tests/test_*.c))

mutants:
	@mkdir -p $(BUILD)/mutants
	python3 tests/mutants.py --jobs 2 $(MUTANTS) $(BUILD)/mutants

check: all $(theories) $(BUILD)/test_outlines
	@sh tests/run.sh $(BUILD)/check.total "sh tests/check.sh $(BUILD)/check"

to = $(DESTDIR)$(PREFIX)
installed = surfmink levelset outlines patic

install: $(addprefix $(BUILD)/,$(installed))
	install -d $(to)/include $(to)/bin $(to)/share/pkgconfig $(to)/share/cmake/surfmink $(to)/share/man/man1
	install -m 644 surfmink.h $(to)/include
	install -m 755 $^ $(to)/bin
	install -m 644 $(installed:%=docs/%.1) $(to)/share/man/man1
	install -m 644 examples/cmake/surfmink-config.cmake examples/cmake/surfmink-config-version.cmake \
	  $(to)/share/cmake/surfmink
	printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' '' 'Name: surfmink' \
	  'Description: surface Minkowski tensors of closed curves, one C header' 'Version: $(VERSION)' \
	  'Cflags: -I$${includedir}' 'Libs: -lm' > $(to)/share/pkgconfig/surfmink.pc

uninstall:
	rm -f $(to)/include/surfmink.h $(installed:%=$(to)/bin/%) $(installed:%=$(to)/share/man/man1/%.1) \
	  $(to)/share/pkgconfig/surfmink.pc $(to)/share/cmake/surfmink/surfmink-config.cmake \
	  $(to)/share/cmake/surfmink/surfmink-config-version.cmake
	[ ! -d $(to)/share/cmake/surfmink ] || rmdir $(to)/share/cmake/surfmink

install-shared: shared
	install -d $(to)/lib
	install -m 755 $(BUILD)/$(library) $(to)/lib
	ln -sf $(library) $(to)/lib/$(library_abi)
	ln -sf $(library_abi) $(to)/lib/$(library_link)

uninstall-shared:
	rm -f $(to)/lib/$(library) $(to)/lib/$(library_abi) $(to)/lib/$(library_link)

clean:
	rm -rf $(BUILD)

.PHONY: all demo paper pictures playground reference test check accuracy bench bench-count fuzz coverage mutants \
  shared install uninstall install-shared uninstall-shared clean

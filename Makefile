# surfmink is one header: copy surfmink.h, there is nothing to build. This file builds what stands around it.
#
#   make            the commands: .build/surfmink, .build/levelset, .build/tissue
#   make demo       measures countries, the H3 grid and a tissue; pictures in .build/demo/
#   make paper      the experiments of the paper, computed beside printed; pictures and tables in .build/paper/
#   make test       all tests; needs cc and make, nothing else
#   make check      compilers, dialects, warnings, sanitizers; needs what .ci/run installs
#   make install    header, pkg-config file and commands; PREFIX=/usr/local, DESTDIR= for packagers
#   make clean      removes .build/, where everything goes
#
# CC, CFLAGS and LDFLAGS are yours to set.  (GNU make)

CC ?= cc
CFLAGS ?= -O2
PREFIX ?= /usr/local
LDLIBS = -lm
BUILD = .build
VERSION := $(shell sed -n '1s/.* v\([0-9.]*\) .*/\1/p' surfmink.h)

commands = surfmink levelset tissue
experiments = $(patsubst examples/paper/%.c,$(BUILD)/paper_%,$(wildcard examples/paper/*.c))
theorems = $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/test_*.c))
headers = surfmink.h $(wildcard examples/*.h examples/*/*.h tests/*.h)

all: $(addprefix $(BUILD)/,$(commands))

$(BUILD)/%: examples/%.c $(headers)
	@mkdir -p $(@D)
	$(CC) -std=c99 $(CPPFLAGS) -I. $(CFLAGS) $< -o $@ $(LDFLAGS) $(LDLIBS)

$(BUILD)/test_%: tests/test_%.c $(headers)
	@mkdir -p $(@D)
	$(CC) -std=c99 $(CPPFLAGS) -I. $(CFLAGS) $< -o $@ $(LDFLAGS) $(LDLIBS)

$(BUILD)/paper_%: examples/paper/%.c $(headers)
	@mkdir -p $(@D)
	$(CC) -std=c99 $(CPPFLAGS) -I. $(CFLAGS) $< -o $@ $(LDFLAGS) $(LDLIBS)

demo: $(BUILD)/surfmink
	@sh examples/demo.sh $(BUILD)/surfmink $(BUILD)/demo

paper: $(experiments)
	@mkdir -p $(BUILD)/paper
	@status=0; for experiment in $(experiments); do $$experiment $(BUILD)/paper || status=1; done; exit $$status

test: all $(theorems)
	@sh tests/run.sh $(BUILD)/test.total $(theorems) \
	  "sh tests/test_command.sh $(BUILD)/surfmink" \
	  "sh tests/test_levelset.sh $(BUILD)/levelset $(BUILD)/surfmink" \
	  "sh tests/test_readme.sh $(BUILD) '$(CC)'"

check:
	@sh tests/run.sh $(BUILD)/check.total "sh tests/check.sh $(BUILD)/check"

install: $(BUILD)/surfmink $(BUILD)/levelset
	install -d $(DESTDIR)$(PREFIX)/include $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(PREFIX)/share/pkgconfig
	install -m 644 surfmink.h $(DESTDIR)$(PREFIX)/include/surfmink.h
	install -m 755 $(BUILD)/surfmink $(BUILD)/levelset $(DESTDIR)$(PREFIX)/bin
	printf '%s\n' 'prefix=$(PREFIX)' 'includedir=$${prefix}/include' '' 'Name: surfmink' \
	  'Description: surface Minkowski tensors of closed curves, one C header' 'Version: $(VERSION)' \
	  'Cflags: -I$${includedir}' 'Libs: -lm' > $(DESTDIR)$(PREFIX)/share/pkgconfig/surfmink.pc

clean:
	rm -rf $(BUILD)

.PHONY: all demo paper test check install clean

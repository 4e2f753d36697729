/* world.h - a world of its own for the main of a command: its options are the first line of the input, one argument a
   word; its files are the rest, which every name leads to; what it says, and what memory it takes, stays in here.

     #include "world.h"             from its end on exit, files and memory lead into this world
     #define main command_main
     #include "examples/command.c"
     #undef main
     world_run(command_main, in)    returns the exit status; world.said and world.complained are the two outputs

   A line that begins with ! has its standard output on a full disk; with ~, on one that says so only when a file is
   closed; one that begins with ? and a byte, from ! = 0 on,
   runs out of memory after so many allocations. Names that begin with "no" do not exist, those that begin with "full"
   lie on a full disk. A byte 0x1e in the rest cuts it in two: names that begin with f, but not these, lead to the
   second part. */
#ifndef FUZZ_WORLD_H
#define FUZZ_WORLD_H

#define _POSIX_C_SOURCE 200809L /* fmemopen, open_memstream */
#include "fuzz.h"

#include <errno.h>
#include <limits.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <time.h>
#include <unistd.h>

#ifndef WORLD_MEMORY
#define WORLD_MEMORY 50000000 /* bytes that a single allocation may have */
#endif

enum { WORLD_LIST = 4096, WORLD_WORDS = 32 };

static struct {
    FILE *in, *out, *err, *file[WORLD_LIST];
    void *memory[WORLD_LIST];
    size_t allocations; /* that still succeed */
    const char *text[2];
    size_t size[2], said_size, complained_size;
    char *said, *complained;
    char line[512], *word[WORLD_WORDS + 2];
    int words, is_full, is_stale, silent; /* an exit status besides 0 that may come without a word; or 0 */
    jmp_buf end;
} world;

/* exit is where a command frees nothing: so all memory is known here, and freed after it. */
static inline void *world_realloc(void *old, size_t size)
{
    void *moved;
    size_t slot = 0;
    while (slot < WORLD_LIST && world.memory[slot] != old) ++slot; /* for a new one: the first free place */
    if (slot == WORLD_LIST || size > WORLD_MEMORY || world.allocations == 0) return NULL;
    --world.allocations;
    moved = realloc(old, size > 0 ? size : 1);
    if (moved) world.memory[slot] = moved;
    return moved;
}

static inline void *world_calloc(size_t count, size_t size)
{
    void *block = size > 0 && count > SIZE_MAX / size ? NULL : world_realloc(NULL, count * size);
    if (block) memset(block, 0, count * size);
    return block;
}

static inline void world_free(void *old)
{
    size_t i;
    for (i = 0; old && i < WORLD_LIST; ++i)
        if (world.memory[i] == old) world.memory[i] = NULL;
    free(old);
}

static FILE *world_text(int part, const char *mode)
{
    return world.size[part] ? fmemopen((void *)(uintptr_t)world.text[part], world.size[part], mode)
                            : fopen("/dev/null", mode);
}

static inline FILE *world_open(const char *name, const char *mode)
{
    size_t i = 0;
    FILE *file;
    if (strncmp(name, "no", 2) == 0) errno = ENOENT;
    if (strncmp(name, "no", 2) == 0) return NULL;
    if (mode[0] == 'w')
        file = fopen(strncmp(name, "full", 4) == 0 ? "/dev/full" : "/dev/null", mode);
    else
        file = world_text(name[0] == 'f', mode);
    while (i < WORLD_LIST - 1 && world.file[i]) ++i;
    world.file[i] = file;
    return file;
}

static inline int world_close(FILE *file)
{
    size_t i;
    for (i = 0; i < WORLD_LIST; ++i)
        if (world.file[i] == file) world.file[i] = NULL;
    if (file == world.out) world.out = NULL;
    if (world.is_stale) errno = ENOSPC;
    return fclose(file) || world.is_stale ? EOF : 0;
}

static inline void world_exit(int status) __attribute__((noreturn));
static inline void world_exit(int status)
{
    longjmp(world.end, status + 1);
}

/* --- one run ------------------------------------------------------------------------------------------------------ */

/* Whether the first line and what follows it make a world. */
static int world_begin(bytes in)
{
    const uint8_t *end = in.left ? (const uint8_t *)memchr(in.at, '\n', in.left) : NULL;
    size_t head = end ? (size_t)(end - in.at) : in.left;
    static char name[] = "command";
    const char *cut;
    char *at = world.line;
    if (head >= sizeof world.line) return 0;
    memset(world.line, 0, sizeof world.line);
    if (head > 0) memcpy(world.line, in.at, head);
    world.text[0] = world.text[1] = end ? (const char *)end + 1 : "";
    world.size[0] = world.size[1] = end ? in.left - head - 1 : 0;
    cut = world.size[0] > 0 ? (const char *)memchr(world.text[0], 0x1e, world.size[0]) : NULL;
    if (cut) {
        world.text[1] = cut + 1;
        world.size[1] = (size_t)(world.text[0] + world.size[0] - world.text[1]);
        world.size[0] = (size_t)(cut - world.text[0]);
    }
    world.is_full = *at == '!';
    world.is_stale = *at == '~';
    if (world.is_full || world.is_stale) ++at;
    world.allocations = SIZE_MAX;
    if (at[0] == '?' && at[1] >= '!') {
        world.allocations = (size_t)(at[1] - '!');
        at += 2;
    }
    world.word[0] = name;
    world.words = 1;
    for (at = strtok(at, " "); at && world.words < WORLD_WORDS; at = strtok(NULL, " ")) world.word[world.words++] = at;
    world.word[world.words] = NULL;
    return 1;
}

/* What a main that returned still had, and what one that exited left. */
static int world_give_back(void)
{
    size_t i;
    int held = 0;
    for (i = 0; i < WORLD_LIST; ++i) {
        held += world.memory[i] || world.file[i];
        if (world.file[i]) fclose(world.file[i]);
        free(world.memory[i]);
        world.file[i] = NULL;
        world.memory[i] = NULL;
    }
    return held;
}

/* Nothing leaks, and what cannot be written is not passed over. After it: free both texts. */
static int world_run(int (*program)(int, char **))
{
    int exits, status, lost;
    world.said = world.complained = NULL;
    world.out = world.is_full ? fopen("/dev/full", "w") : open_memstream(&world.said, &world.said_size);
    world.err = open_memstream(&world.complained, &world.complained_size);
    world.in = world_text(0, "rb");
    CLAIM(world.in && world.out && world.err);
    exits = setjmp(world.end);
    status = exits ? exits - 1 : program(world.words, world.word);
    lost = world.is_stale || (world.out && ferror(world.out)); /* else it was closed, which tells what is lost */
    if (world.out) lost |= fclose(world.out) != 0;
    fclose(world.err);
    fclose(world.in);
    exits = !world_give_back() || exits;
    CLAIM(exits); /* nothing is held when main returns */
    CLAIM(!lost || status != 0);
    CLAIM(status == 0 || status == world.silent || world.complained_size > 0);
    return status;
}

static void world_end(void)
{
    free(world.said);
    free(world.complained);
}

/* Every line of a table has as many columns as its head; lines that begin with # are none. */
static void claim_table(const char *text)
{
    size_t head = 0, tabs = 0;
    int has_head = 0, is_comment = *text == '#';
    for (; *text; ++text) {
        tabs += *text == '\t';
        if (*text != '\n') continue;
        if (!is_comment && !has_head) head = tabs;
        if (!is_comment) has_head = 1;
        CLAIM(is_comment || tabs == head);
        is_comment = text[1] == '#';
        tabs = 0;
    }
    CLAIM(tabs == 0);
}

#undef stdin
#undef stdout
#undef stderr
#undef putchar
#define stdin               world.in
#define stdout              world.out
#define stderr              world.err
#define putchar(c)          fputc(c, world.out)
#define puts(text)          fprintf(world.out, "%s\n", text)
#define printf(...)         fprintf(world.out, __VA_ARGS__)
#define exit(status)        world_exit(status)
#define fopen               world_open
#define fclose              world_close
#define free                world_free
#define realloc             world_realloc
#define malloc(size)        world_realloc(NULL, size)
#define calloc(count, size) world_calloc(count, size)

#endif

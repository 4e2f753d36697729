/* command.c - fuzzes the command: its options (the first line of the input, one argument a word) and its readers (the
   rest, which every file name leads to). Runs main itself, with exit, files and memory redirected. */
#define _POSIX_C_SOURCE 200809L /* fmemopen, open_memstream */
#include "fuzz.h"

#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <time.h>
#include <unistd.h>

/* --- a world of its own for main ---------------------------------------------------------------------------------- */

enum { LONGEST_LIST = 4096, WORDS = 32 };

static jmp_buf the_end;
static FILE *world_in, *world_out, *world_err, *world_file[LONGEST_LIST];
static void *world_memory[LONGEST_LIST];
static const char *world_text;
static size_t world_size;

/* exit is where a command frees nothing: so all memory is known here, and freed after it. */
static void *world_realloc(void *old, size_t size)
{
    void *moved;
    size_t i = 0, slot;
    while (i < LONGEST_LIST && world_memory[i] != old) ++i;
    slot = i;
    if (!old)
        for (slot = 0; slot < LONGEST_LIST && world_memory[slot];) ++slot;
    if (slot == LONGEST_LIST || size > 50000000) return NULL;
    moved = realloc(old, size > 0 ? size : 1);
    if (moved) world_memory[slot] = moved;
    return moved;
}

static void world_free(void *old)
{
    size_t i;
    for (i = 0; old && i < LONGEST_LIST; ++i)
        if (world_memory[i] == old) world_memory[i] = NULL;
    free(old);
}

static FILE *world_open(const char *name, const char *mode)
{
    size_t i = 0;
    FILE *file;
    if (strncmp(name, "no", 2) == 0) errno = ENOENT;
    if (strncmp(name, "no", 2) == 0) return NULL;
    file = mode[0] == 'w' ? fopen("/dev/null", mode)
           : world_size   ? fmemopen((void *)(uintptr_t)world_text, world_size, mode)
                          : fopen("/dev/null", mode);
    while (i < LONGEST_LIST - 1 && world_file[i]) ++i;
    world_file[i] = file;
    return file;
}

static int world_close(FILE *file)
{
    size_t i;
    for (i = 0; i < LONGEST_LIST; ++i)
        if (world_file[i] == file) world_file[i] = NULL;
    return fclose(file);
}

static void world_exit(int status) __attribute__((noreturn));
static void world_exit(int status)
{
    longjmp(the_end, status + 1);
}

#undef stdin
#undef stdout
#undef stderr
#undef putchar
#define stdin           world_in
#define stdout          world_out
#define stderr          world_err
#define putchar(c)      fputc(c, world_out)
#define printf(...)     fprintf(world_out, __VA_ARGS__)
#define exit(status)    world_exit(status)
#define fopen           world_open
#define fclose          world_close
#define free            world_free
#define realloc         world_realloc
#define malloc(size)    world_realloc(NULL, size)
#define calloc(n, size) world_calloc(n, size)
static inline void *world_calloc(size_t n, size_t size)
{
    void *block = size > 0 && n > SIZE_MAX / size ? NULL : world_realloc(NULL, n * size);
    if (block) memset(block, 0, n * size);
    return block;
}
#define HAS_POSIX 0 /* streams in memory have nothing to poll */
#define main      command_main
#include "examples/surfmink.c"
#undef main
#undef calloc
#undef malloc
#undef realloc
#undef free
#undef fclose
#undef fopen
#undef exit
#undef printf

/* --- the harness -------------------------------------------------------------------------------------------------- */

/* Every line of a table has as many columns as its head. */
static void claim_table(const char *text)
{
    size_t head = 0, tabs = 0;
    int first = 1;
    for (; *text; ++text) {
        tabs += *text == '\t';
        if (*text != '\n') continue;
        if (first) head = tabs;
        CLAIM(tabs == head);
        first = 0;
        tabs = 0;
    }
    CLAIM(tabs == 0);
}

static char first_line[512], *said, *complained;
static int is_table;

static int run_command(void)
{
    char *word[WORDS + 2], name[] = "surfmink", *at = strtok(first_line, " ");
    int words = 1, status;
    word[0] = name;
    is_table = 1;
    for (; at && words < WORDS; at = strtok(NULL, " ")) {
        word[words++] = at;
        if (at[0] == '-' && strchr("-jhV", at[1]) && at[1] && strpbrk(at, "jhvV")) is_table = 0; /* JSON, texts */
    }
    word[words] = NULL;
    status = setjmp(the_end);
    return status ? status - 1 : command_main(words, word);
}

static void fuzz(bytes in)
{
    const uint8_t *end = in.left ? (const uint8_t *)memchr(in.at, '\n', in.left) : NULL;
    size_t head = end ? (size_t)(end - in.at) : in.left, size = 0, other = 0, i;
    int status;
    if (head >= sizeof first_line) return;
    memset(first_line, 0, sizeof first_line);
    if (head > 0) memcpy(first_line, in.at, head);
    world_size = end ? in.left - head - 1 : 0;
    world_text = end ? (const char *)end + 1 : "";
    world_out = open_memstream(&said, &size);
    world_err = open_memstream(&complained, &other);
    world_in = world_size ? fmemopen((void *)(uintptr_t)world_text, world_size, "rb") : fopen("/dev/null", "rb");
    CLAIM(world_in && world_out && world_err);
    progress_is_shown = 0;
    held_back.write = NULL; /* of a run that ended early */
    status = run_command();
    fclose(world_out);
    fclose(world_err);
    fclose(world_in);
    CLAIM(status == EXIT_MEASURED || status == EXIT_TROUBLE || status == EXIT_REFUSED);
    CLAIM(status != EXIT_TROUBLE || other > 0);
    if (is_table) claim_table(said);
    free(said);
    free(complained);
    for (i = 0; i < LONGEST_LIST; ++i) {
        if (world_file[i]) fclose(world_file[i]);
        free(world_memory[i]);
        world_file[i] = NULL;
        world_memory[i] = NULL;
    }
}

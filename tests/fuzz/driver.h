/* driver.h - the main of a harness where there is no libFuzzer.

     harness FILE...                  each file once, for instance the corpus
     harness --random RUNS FILE...    and then random strings, half of them files with some bytes changed */
#ifndef FUZZ_DRIVER_H
#define FUZZ_DRIVER_H

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DRIVER_LONGEST = 4096 };

static uint32_t driver_state = 2463534242u;

/* xorshift: the same strings on every machine. */
static uint32_t driver_random(uint32_t below)
{
    driver_state ^= driver_state << 13;
    driver_state ^= driver_state >> 17;
    driver_state ^= driver_state << 5;
    return driver_state % below;
}

static size_t driver_read(const char *name, uint8_t *data)
{
    size_t size;
    FILE *file = fopen(name, "rb");
    if (!file) {
        perror(name);
        exit(2);
    }
    size = fread(data, 1, DRIVER_LONGEST, file);
    fclose(file);
    return size;
}

/* A buffer of exactly the right size, so that address sanitizers see a byte read beyond its end. */
static void driver_run(const uint8_t *data, size_t size)
{
    uint8_t *exact = (uint8_t *)malloc(size > 0 ? size : 1);
    if (!exact) exit(2);
    memcpy(exact, data, size);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
}

int main(int argc, char **argv)
{
    static uint8_t data[DRIVER_LONGEST];
    long runs = 0, k;
    size_t size, i;
    int first = 1, file;
    if (argc > 2 && strcmp(argv[1], "--random") == 0) {
        runs = atol(argv[2]);
        first = 3;
    }
    for (file = first; file < argc; ++file) driver_run(data, driver_read(argv[file], data));
    for (k = 0; k < runs; ++k) {
        if (argc > first && k % 2) {
            size = driver_read(argv[first + (int)driver_random((uint32_t)(argc - first))], data);
            for (i = driver_random(8); size > 0 && i > 0; --i)
                data[driver_random((uint32_t)size)] = (uint8_t)driver_random(256);
        } else {
            size = driver_random(400);
            for (i = 0; i < size; ++i) data[i] = (uint8_t)driver_random(256);
        }
        driver_run(data, size);
    }
    return 0;
}

#endif

/* Repeats recorded calls of a library of another system, and writes what they leave in memory. */

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef _WIN32
#include <windows.h>
#define open_library(path) ((void *)LoadLibraryA(path))
#define find(library, name) ((void *)GetProcAddress((HMODULE)(library), name))
#else
#include <dlfcn.h>
#define open_library(path) dlopen(path, RTLD_NOW)
#define find dlsym
#endif

typedef int32_t (*caller)(void *function, const uint64_t *words);

static double number(uint64_t word) {
    double value;
    memcpy(&value, &word, sizeof value);
    return value;
}

#include "calls.h"

static uint64_t next(FILE *file) {
    uint64_t word;
    if (fread(&word, sizeof word, 1, file) != 1) exit(3);
    return word;
}

int main(int count, char **arguments) {
    static char *regions[100000];
    static uint64_t words[256], result[16];
    if (count != 4) return 2;
    void *library = open_library(arguments[1]);
    FILE *in = fopen(arguments[2], "rb"), *out = fopen(arguments[3], "wb");
    if (!library || !in || !out) return 4;
    for (;;) {
        uint64_t what = next(in);
        if (what == 'E') break;
        if (what == 'N') { /* memory, placed on the same part of a cache line */
            uint64_t id = next(in), size = next(in), place = next(in);
            char *room = calloc(1, size + 192);
            if (!room) return 5;
            regions[id] = room + (64 - (uintptr_t)room % 64) + place;
        } else if (what == 'W') { /* its content, in which some words are addresses */
            uint64_t id = next(in), size = next(in);
            if (size && fread(regions[id], 1, size, in) != size) return 3;
            for (uint64_t left = next(in); left; left--) {
                uint64_t at = next(in), other = next(in), delta = next(in);
                char *address = regions[other] + delta;
                memcpy(regions[id] + at, &address, sizeof address);
            }
        } else if (what == 'C') { /* a call */
            uint64_t symbol = next(in), length = next(in), raised = 0;
            void *function = find(library, NAMES[symbol]);
            if (!function) return 6;
            memset(result, 0, sizeof result);
            for (uint64_t i = 0; i < length; i++) {
                uint64_t region = next(in), value = next(in);
                words[i + 2] = region ? (uint64_t)(uintptr_t)(regions[region] + value) : value;
            }
            words[0] = (uint64_t)(uintptr_t)result;
            words[1] = (uint64_t)(uintptr_t)&raised;
            int64_t status = CALLERS[symbol](function, words);
            fwrite(&status, sizeof status, 1, out);
            fwrite(result, sizeof result, 1, out);
        } else if (what == 'R') { /* what is in memory now */
            uint64_t id = next(in), at = next(in), size = next(in);
            fwrite(regions[id] + at, 1, size, out);
        } else {
            return 7;
        }
    }
    fclose(out);
    return 0;
}

/* What libraries of macOS import of it, and Linux has not. */

#include <math.h>
#include <stdlib.h>
#include <string.h>

#pragma GCC visibility push(hidden) /* the library's own, whatever else is loaded */

struct pair {
    double sine, cosine;
};

struct pair __sincos_stret(double angle) {
    return (struct pair){sin(angle), cos(angle)};
}

void memset_pattern16(char *memory, const char *pattern, size_t size) {
    for (size_t i = 0; i < size; i++) memory[i] = pattern[i % 16];
}

void __bzero(void *memory, size_t size) {
    memset(memory, 0, size);
}

/* Finds a function at its first call; all are bound before. */
void dyld_stub_binder(void) {
    abort();
}

#include "bench.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

double bench_now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void bench_keep(const void* pointer) {
    __asm__ volatile("" : : "g"(pointer) : "memory");
}

void bench_row(const char* name, double value, const char* unit, const char* peer,
               double peer_value, double target) {
    const int rate = strstr(unit, "/s") != NULL; // more is better
    printf("%-58s %10.4g %-9s", name, value, unit);
    if (peer)
        printf("  %-18s %10.4g  ratio %7.2f", peer, peer_value,
               rate ? value / peer_value : peer_value / value);
    else
        printf("  %-18s %10s  %13s", "", "", "");
    if (target > 0)
        printf("  target %8.4g %s", target,
               (rate ? value >= target : value <= target) ? "met" : "MISSED");
    printf("\n");
    fflush(stdout);
}

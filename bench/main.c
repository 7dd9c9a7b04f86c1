/// Runs all benchmarks, or those named on the command line.
#include "bench.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char* name;
    void (*run)(void);
} groups[] = {
    {"mechanics", bench_mechanics}, {"cable", bench_cable},
    {"landing", bench_landing},     {"campaign", bench_campaign},
    {"ledger", bench_ledger},       {"rigs", bench_rigs},
    {"surrogate", bench_surrogate}, {"calibration", bench_calibration},
};

int main(int argc, char** argv) {
    for (size_t i = 0; i < sizeof groups / sizeof groups[0]; ++i) {
        int wanted = argc < 2;
        for (int k = 1; k < argc; ++k)
            wanted = wanted || strcmp(argv[k], groups[i].name) == 0;
        if (!wanted)
            continue;
        printf("%s\n", groups[i].name);
        groups[i].run();
    }
    return 0;
}

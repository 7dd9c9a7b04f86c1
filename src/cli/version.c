#include "cli/version.h"

#include "base/arithmetic.h"
#include "base/threads.h"
#include "cluster/cluster.h"
#include "report/page.h"
#include "surrogate/predictor.h"

#include <gnu/libc-version.h>
#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <libsvm/svm.h>
#include <nlopt.h>
#include <sqlite3.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>
#include <yaml.h>

/// As the kernel names it; "unknown" where it does not.
static void processor_name(char* name, size_t size) {
    char line[256];
    FILE* file = fopen("/proc/cpuinfo", "r");
    snprintf(name, size, "unknown");
    while (file && fgets(line, sizeof line, file)) {
        const char* colon = strncmp(line, "model name", 10) == 0 ? strchr(line, ':') : NULL;
        if (!colon)
            continue;
        snprintf(name, size, "%.*s", (int)strcspn(colon + 2, "\n"), colon + 2);
        break;
    }
    if (file)
        fclose(file);
}

/// What a run may depend on that is not in the program.
static void print_machine(FILE* out) {
    char processor[128];
    struct utsname system;
    processor_name(processor, sizeof processor);
    fprintf(out, "processor %s, %d of %ld cores usable\n", processor, bt_thread_count(0),
            sysconf(_SC_NPROCESSORS_ONLN));
    if (uname(&system) == 0)
        fprintf(out, "system    %s %s %s, glibc %s\n", system.sysname, system.release,
                system.machine, gnu_get_libc_version());
    const char* fault = bt_arithmetic_fault();
    fprintf(out, "numbers   %s\n", fault ? fault : "rounded to nearest, denormal numbers kept");
}

void bt_version_print(FILE* out, bool verbose) {
    static const char* const level[BT_ISA_LEVELS] = {"x86-64-v1", "x86-64-v3", "x86-64-v4"};
    fprintf(out, "bolter %s\n", BT_VERSION);
    if (!verbose)
        return;
    unsigned hdf5[3] = {0};
    int nlopt[3] = {0};
    H5get_libversion(&hdf5[0], &hdf5[1], &hdf5[2]);
    nlopt_version(&nlopt[0], &nlopt[1], &nlopt[2]);
    print_machine(out);
    fprintf(out, "compiler  gcc %s\nflags     %s\n", __VERSION__, BT_FLAGS);
    fprintf(out, "kernels   %s (the best of this build on this machine)\n", level[bt_isa_best()]);
    fprintf(out, "libyaml   %s\nsqlite    %s\n", yaml_get_version_string(), sqlite3_libversion());
    fprintf(out, "gsl       %s\nhdf5      %u.%u.%u\nnlopt     %d.%d.%d\nlibsvm    %d.%02d\n",
            gsl_version, hdf5[0], hdf5[1], hdf5[2], nlopt[0], nlopt[1], nlopt[2],
            libsvm_version / 100, libsvm_version % 100);
    const char* mpi = bt_cluster_version();
    fprintf(out, "mpi       %s\npage      %s\n", mpi ? mpi : "built without",
            bt_page_available(NULL) ? "in this build" : "built without");
    fprintf(out,
            "Licence GPL-3.0-or-later. There is no warranty, to the extent permitted by law.\n");
}

const char* bt_version_build(void) {
    return "gcc " __VERSION__ ", " BT_FLAGS;
}

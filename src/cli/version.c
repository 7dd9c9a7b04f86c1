#include "cli/version.h"

#include "cluster/cluster.h"
#include "surrogate/predictor.h"

#include <gsl/gsl_version.h>
#include <hdf5.h>
#include <nlopt.h>
#include <sqlite3.h>
#include <yaml.h>

void bt_version_print(FILE* out, bool verbose) {
    static const char* const level[BT_ISA_LEVELS] = {"x86-64-v1", "x86-64-v3", "x86-64-v4"};
    fprintf(out, "bolter %s\n", BT_VERSION);
    if (!verbose)
        return;
    unsigned hdf5[3] = {0};
    int nlopt[3] = {0};
    H5get_libversion(&hdf5[0], &hdf5[1], &hdf5[2]);
    nlopt_version(&nlopt[0], &nlopt[1], &nlopt[2]);
    fprintf(out, "compiler  gcc %s\nflags     %s\n", __VERSION__, BT_FLAGS);
    fprintf(out, "kernels   %s (the best of this build on this machine)\n", level[bt_isa_best()]);
    fprintf(out, "libyaml   %s\nsqlite    %s\n", yaml_get_version_string(), sqlite3_libversion());
    fprintf(out, "gsl       %s\nhdf5      %u.%u.%u\nnlopt     %d.%d.%d\n", gsl_version, hdf5[0],
            hdf5[1], hdf5[2], nlopt[0], nlopt[1], nlopt[2]);
    const char* mpi = bt_cluster_version();
    if (mpi)
        fprintf(out, "mpi       %s\n", mpi);
    fprintf(out,
            "Licence GPL-3.0-or-later. There is no warranty, to the extent permitted by law.\n");
}

const char* bt_version_build(void) {
    return "gcc " __VERSION__ ", " BT_FLAGS;
}

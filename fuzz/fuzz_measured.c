/// The reader of measured curves under libFuzzer: any file is read or refused with a reason.
///
///     fuzz_measured fuzz/seeds/measured
#define _GNU_SOURCE
#include "study/measured.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

static void read_as(const char* path, const bt_measured_columns* columns) {
    static const char* const names[] = {"time_s", "stroke_m", "strut_force_N"};
    bt_measured* m = NULL;
    bt_diag diag = {0};
    bt_status status = bt_measured_read(path, columns, &m, &diag);
    if (status == BT_OK)
        status = bt_measured_bind(m, names, 3, &diag);
    if ((status == BT_OK) != (diag.errors == 0))
        abort(); // refused without a word, or accepted with a complaint
    bt_measured_destroy(m);
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static const bt_measured_columns columns = {.x_heading = "Time",
                                                .x_name = "time",
                                                .y_heading = "Load cell",
                                                .y_name = "strut_force",
                                                .offset = "1 ms"};
    char path[64];
    const int file = memfd_create("fuzz", 0);
    if (file < 0 || write(file, data, size) != (ssize_t)size)
        abort();
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    read_as(path, NULL);
    read_as(path, &columns);
    close(file);
    return 0;
}

#include "base/clock.h"
#include "cli/cli.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <unistd.h>

void bt_duration_text(double seconds, char* text, size_t size) {
    const long s = isfinite(seconds) && seconds < 1e9 ? lround(seconds) : -1;
    if (s < 0)
        snprintf(text, size, "?");
    else if (s < 60)
        snprintf(text, size, "%ld s", s);
    else if (s < 3600)
        snprintf(text, size, "%ld min %02ld s", s / 60, s % 60);
    else
        snprintf(text, size, "%ld h %02ld min", s / 3600, s / 60 % 60);
}

bt_progress bt_progress_start(const char* name, bool quiet) {
    return (bt_progress){.name = name,
                         .quiet = quiet,
                         .terminal = isatty(STDERR_FILENO) != 0,
                         .shown_s = bt_clock_s()};
}

void bt_progress_show(bt_progress* progress, bool last, const char* format, ...) {
    const double interval_s = progress->terminal ? 0.2 : 60.0;
    const double now_s = bt_clock_s();
    if (progress->quiet || (!last && now_s - progress->shown_s < interval_s))
        return;
    progress->shown_s = now_s;
    fprintf(stderr, "%s%s: ", progress->terminal ? "\r\033[K" : "", progress->name);
    va_list args;
    va_start(args, format);
    vfprintf(stderr, format, args);
    va_end(args);
    if (last || !progress->terminal)
        fputc('\n', stderr);
    fflush(stderr);
}

#define _GNU_SOURCE /* timer_create */
#include "base/units.h"
#include "cli/cli.h"

#include <math.h>
#include <signal.h>
#include <time.h>

bt_status bt_time_limit(const bt_command* command, const char* text) {
    double limit_s = 0;
    char why[256] = "";
    if (!text)
        return BT_OK;
    if (bt_unit_parse(text, "s", &limit_s, why, sizeof why) != BT_OK)
        return bt_usage_error(command, "--time-limit: %s", why);
    const double most_s = 1e8; // three years
    if (!(limit_s >= 1 && limit_s <= most_s))
        return bt_usage_error(command, "--time-limit: \"%s\" is not from 1 s to 1e8 s", text);
    struct sigevent ask = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGUSR1};
    const struct itimerspec after = {
        .it_value = {.tv_sec = (time_t)limit_s,
                     .tv_nsec = (long)(1e9 * (limit_s - floor(limit_s)))}};
    timer_t timer;
    if (timer_create(CLOCK_MONOTONIC, &ask, &timer) != 0 ||
        timer_settime(timer, 0, &after, NULL) != 0) {
        bt_say_error(command, "--time-limit: the system gives no timer");
        return BT_ERR_INTERNAL;
    }
    return BT_OK;
}

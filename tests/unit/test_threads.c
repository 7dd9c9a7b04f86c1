/// Threads and tasks: how many, each task once, and what an error leaves out.
#define _GNU_SOURCE /* sched_setaffinity */
#include "near.h"

#include "base/threads.h"

#include <sched.h>
#include <stdatomic.h>
#include <string.h>

/// A batch system or taskset gives a process fewer cores than the machine has.
static void threads_are_the_cores_of_the_affinity(void** state) {
    (void)state;
    cpu_set_t all, one;
    assert_int_equal(sched_getaffinity(0, sizeof all, &all), 0);
    assert_int_equal(bt_thread_count(0), CPU_COUNT(&all));
    assert_int_equal(bt_thread_count(-3), CPU_COUNT(&all));
    CPU_ZERO(&one);
    for (size_t core = 0; core < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++core)
        if (CPU_ISSET(core, &all))
            CPU_SET(core, &one);
    assert_int_equal(sched_setaffinity(0, sizeof one, &one), 0);
    assert_int_equal(bt_thread_count(0), 1);
    assert_int_equal(bt_thread_count(5), 5);
    assert_int_equal(bt_thread_count(1 << 20), BT_THREADS_MAX);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
}

enum { TASKS = 1000 };

typedef struct record {
    atomic_int times[TASKS];
    atomic_int worker_seen[8];
    int fails_from;
} record;

static bt_status note(void* user, int task, int worker) {
    record* r = user;
    atomic_fetch_add(&r->times[task], 1);
    atomic_store(&r->worker_seen[worker], 1);
    return task >= r->fails_from ? BT_ERR_NUMERIC : BT_OK;
}

static void every_task_runs_once_for_any_number_of_threads(void** state) {
    (void)state;
    for (int threads = 1; threads <= 7; threads += 3) {
        record r;
        memset(&r, 0, sizeof r);
        r.fails_from = TASKS;
        assert_int_equal(bt_tasks_run(threads, TASKS, note, &r), BT_OK);
        for (int i = 0; i < TASKS; ++i)
            assert_int_equal(r.times[i], 1);
        assert_int_equal(r.worker_seen[0] + r.worker_seen[1] > 0, 1);
        assert_int_equal(r.worker_seen[7], 0);
    }
    record none;
    memset(&none, 0, sizeof none);
    assert_int_equal(bt_tasks_run(4, 0, note, &none), BT_OK);
}

static void an_error_leaves_out_what_has_not_begun(void** state) {
    (void)state;
    record r;
    memset(&r, 0, sizeof r);
    r.fails_from = 10;
    assert_int_equal(bt_tasks_run(1, TASKS, note, &r), BT_ERR_NUMERIC);
    assert_int_equal(r.times[10], 1);
    assert_int_equal(r.times[11], 0);
}

static void count_start(void* user, int worker) {
    atomic_int* started = user;
    atomic_fetch_add(&started[worker], 1);
}

static void workers_run_their_function_once(void** state) {
    (void)state;
    atomic_int started[3] = {0};
    bt_workers* workers = NULL;
    assert_int_equal(bt_workers_start(3, count_start, started, &workers), BT_OK);
    bt_workers_join(workers);
    for (int i = 0; i < 3; ++i)
        assert_int_equal(started[i], 1);
    bt_workers_join(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(threads_are_the_cores_of_the_affinity),
        cmocka_unit_test(every_task_runs_once_for_any_number_of_threads),
        cmocka_unit_test(an_error_leaves_out_what_has_not_begun),
        cmocka_unit_test(workers_run_their_function_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/// Threads, the one place where they are started, and independent tasks on them. Which thread runs
/// a task never shows in a result: a task writes only what is its own, and sums are made afterwards
/// in task order.
#ifndef BT_BASE_THREADS_H
#define BT_BASE_THREADS_H

#include "base/status.h"

enum { BT_THREADS_MAX = 1024 };

/// Threads for a request: itself, or, when it is 0 or less, one per core that this process may use
/// (its affinity, as a batch system or taskset sets it). 1 .. BT_THREADS_MAX.
int bt_thread_count(int requested);

/// @param worker  0 .. count - 1
typedef void bt_worker_main(void* user, int worker);

/// A group of threads that each run one function once.
typedef struct bt_workers bt_workers;

/// Starts `count` threads, or as many as can be had. BT_ERR_MEMORY: not even one.
BT_CHECKED bt_status bt_workers_start(int count, bt_worker_main* run, void* user,
                                      bt_workers** workers);

/// Waits until every thread has returned, and gives the group back. NULL is nothing.
void bt_workers_join(bt_workers* workers);

/// @param task    0 .. count - 1
/// @param worker  0 .. threads - 1: scratch memory may be kept per worker
/// @return BT_OK, or what stops the rest: tasks not yet begun are then left out
typedef bt_status bt_task(void* user, int task, int worker);

/// Runs all tasks and returns when they are done. When a thread cannot be started, the others do
/// its work. Returns the status of the first failed task in task order, or BT_OK.
///
/// @param threads  see bt_thread_count
BT_CHECKED bt_status bt_tasks_run(int threads, int count, bt_task* run, void* user);

#endif

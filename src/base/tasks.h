/// Independent tasks on threads. Which thread runs a task never shows in a result: a task writes
/// only what is its own, and sums are made afterwards in task order.
#ifndef BT_BASE_TASKS_H
#define BT_BASE_TASKS_H

#include "base/status.h"

/// @param task    0 .. count - 1
/// @param worker  0 .. threads - 1: scratch memory may be kept per worker
/// @return BT_OK, or what stops the rest: tasks not yet begun are then left out
typedef bt_status bt_task(void* user, int task, int worker);

/// The number of threads that `threads` stands for: itself, or one per core when 0 or less.
int bt_tasks_threads(int threads);

/// Runs all tasks and returns when they are done. When a thread cannot be started, the others do
/// its work. Returns the status of the first failed task in task order, or BT_OK.
BT_CHECKED bt_status bt_tasks_run(int threads, int count, bt_task* run, void* user);

#endif

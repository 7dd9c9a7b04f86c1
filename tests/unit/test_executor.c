/// The executor with a back end of our own (results in any order, on demand), and landings whose
/// numbers are impossible.
#define _GNU_SOURCE /* nftw */
#include "near.h"

#include "campaign/simulated_backend.h"
#include "toy_study.h"

#include <string.h>

enum { JOBS = 50, ROOM = 7 };

/// A back end that computes nothing: it gives the last job in hand back first.
typedef struct stack {
    bt_job jobs[ROOM];
    int count, most;
} stack;

static stack the_stack;
static bt_status job_status;

static bt_status open_stack(const bt_executor* executor, void** state, int* room, bt_diag* diag) {
    (void)executor;
    (void)diag;
    the_stack = (stack){.count = 0};
    *state = &the_stack;
    *room = ROOM;
    return BT_OK;
}

static void submit(void* state, const bt_job* job) {
    stack* s = state;
    assert_true(s->count < ROOM);
    s->jobs[s->count++] = *job;
    if (s->count > s->most)
        s->most = s->count;
}

static int receive(void* state, bt_finished* finished, int most, double wait_s) {
    stack* s = state;
    assert_true(wait_s >= 0);
    int given = 0;
    for (; given < most && given < 3 && s->count > 0; ++given) {
        memset(&finished[given], 0, sizeof *finished);
        finished[given].job = s->jobs[--s->count];
        finished[given].result.margin_m = finished[given].job.x[0];
        finished[given].status = finished[given].job.run == 20 ? job_status : BT_OK;
        snprintf(finished[given].message, sizeof finished[given].message, "a machine is gone");
    }
    return given;
}

static int cancel(void* state, bool abandon) {
    (void)abandon;
    stack* s = state;
    const int forgotten = s->count;
    s->count = 0;
    return forgotten;
}

static void close_stack(void* state) {
    assert_ptr_equal(state, &the_stack);
}

static const bt_backend stack_backend = {
    .name = "stack",
    .open = open_stack,
    .submit = submit,
    .receive = receive,
    .cancel = cancel,
    .close = close_stack,
};

typedef struct batch {
    int next, times[JOBS], taken, stop_after, fail_after;
    atomic_int stop;
} batch;

static bool give(void* user, bt_job* job) {
    batch* b = user;
    if (b->next == JOBS)
        return false;
    job->run = b->next++;
    job->x[0] = 0.5 * (double)job->run;
    return true;
}

static bt_status take(void* user, const bt_job* job, const bt_landing_result* result) {
    batch* b = user;
    ++b->times[job->run];
    assert_true(result->margin_m == 0.5 * (double)job->run);
    if (++b->taken == b->stop_after)
        atomic_store(&b->stop, 1);
    return b->taken == b->fail_after ? BT_ERR_IO : BT_OK;
}

static bt_status run_batch(batch* b, bt_diag* diag) {
    const bt_axes axes = {.count = 1};
    const bt_executor executor = {.axes = &axes,
                                  .stop = &b->stop,
                                  .source = give,
                                  .sink = take,
                                  .user = b,
                                  .backend = &stack_backend};
    return bt_executor_run(&executor, diag);
}

static void every_job_goes_through_any_back_end_once(void** state) {
    (void)state;
    batch b = {0};
    job_status = BT_OK;
    assert_int_equal(run_batch(&b, NULL), BT_OK);
    for (int i = 0; i < JOBS; ++i)
        assert_int_equal(b.times[i], 1);
    assert_int_equal(the_stack.most, ROOM);
}

static void a_stop_leaves_jobs_over_but_none_in_hand(void** state) {
    (void)state;
    batch b = {.stop_after = 5};
    job_status = BT_OK;
    assert_int_equal(run_batch(&b, NULL), BT_ERR_INTERRUPTED);
    assert_in_range(b.taken, 5, 7); // what was received together is kept
    assert_int_equal(the_stack.count, 0);
    batch last = {.stop_after = JOBS}; // a stop after the last job is none
    assert_int_equal(run_batch(&last, NULL), BT_OK);
}

static void an_error_of_the_sink_ends_the_batch(void** state) {
    (void)state;
    batch b = {.fail_after = 4};
    job_status = BT_OK;
    assert_int_equal(run_batch(&b, NULL), BT_ERR_IO);
    assert_int_equal(b.taken, 4);
}

static void an_error_of_the_back_end_is_said(void** state) {
    (void)state;
    batch b = {0};
    toy_messages messages;
    bt_diag diag = toy_diag(&messages);
    job_status = BT_ERR_IO;
    assert_int_equal(run_batch(&b, &diag), BT_ERR_IO);
    assert_string_equal(messages.last, "a machine is gone");
    assert_int_equal(b.times[20], 0);
    job_status = BT_ERR_INTERRUPTED; // given up: may be run again
    batch again = {0};
    assert_int_equal(run_batch(&again, &diag), BT_ERR_INTERRUPTED);
    assert_int_equal(again.taken, JOBS - 1);
}

// --- impossible numbers -----------------------------------------------------------------------

typedef struct fixture {
    bt_model_params model;
    bt_lander* lander;
} fixture;

static int setup(void** state) {
    bt_study* study = malloc(sizeof *study);
    fixture* f = malloc(sizeof *f);
    assert_int_equal(bt_study_read("studies/reference/study.yaml", NULL, 0, study, NULL), BT_OK);
    f->model = study->model;
    bt_study_destroy(study);
    free(study);
    assert_int_equal(bt_lander_create(&f->lander), BT_OK);
    *state = f;
    return 0;
}

static int teardown(void** state) {
    fixture* f = *state;
    bt_lander_destroy(f->lander);
    free(f);
    return 0;
}

/// The landing with one number changed must be a failed one that names key and limit.
static void assert_refused(fixture* f, const char* path, double value, const char* element,
                           const char* limit) {
    bt_landing_result result;
    bt_model_params model = f->model;
    size_t offset;
    const bt_field* field = bt_group_find(&bt_model_group, path, &offset);
    bt_field_set(field, &model, offset, value);
    assert_int_equal(bt_landing_try(f->lander, &model, &result, NULL, NULL), BT_OK);
    assert_int_equal(result.outcome, BT_FAILED);
    assert_string_equal(result.failed_element, element);
    if (!strstr(result.failed_quantity, limit))
        fail_msg("\"%s\" is not in: %s", limit, result.failed_quantity);
    assert_true(isnan(result.margin_m));
}

static void impossible_numbers_are_failed_landings_with_key_and_limit(void** state) {
    fixture* f = *state;
    assert_refused(f, "aircraft.mass", 300, "aircraft.mass", "527.9 kg");
    assert_refused(f, "aircraft.inertia_yy", 3.58e5, "aircraft.inertia_yy", "358572 .. 529932");
    assert_refused(f, "aircraft.inertia_xx", 100, "aircraft.inertia_xx", "above");
    assert_refused(f, "deck.cable.pretension", 300, "deck.cable.pretension", "above");
    bt_landing_result result; // and the lander is as good as before
    assert_int_equal(bt_landing_try(f->lander, &f->model, &result, NULL, NULL), BT_OK);
    assert_int_not_equal(result.outcome, BT_FAILED);
}

/// The bound named is the bound: the triangle inequality of the fuselage's principal moments.
static void inertia_is_accepted_up_to_the_limit_named(void** state) {
    fixture* f = *state;
    bt_model_params model = f->model;
    model.aircraft.inertia_yy_kgm2 = 358573;
    assert_int_equal(bt_lander_prepare(f->lander, &model, NULL), BT_OK);
    model.aircraft.inertia_yy_kgm2 = 358571;
    assert_int_equal(bt_lander_prepare(f->lander, &model, NULL), BT_ERR_INPUT);
    model.aircraft.inertia_yy_kgm2 = 529933;
    assert_int_equal(bt_lander_prepare(f->lander, &model, NULL), BT_ERR_INPUT);
}

static void a_stopped_landing_is_no_result(void** state) {
    fixture* f = *state;
    atomic_int stop = 1;
    bt_landing_result result;
    bt_lander_obey(f->lander, &stop);
    assert_int_equal(bt_landing_try(f->lander, &f->model, &result, NULL, NULL), BT_ERR_INTERRUPTED);
    bt_lander_obey(f->lander, NULL);
}

#define MODEL(name) cmocka_unit_test_setup_teardown(name, setup, teardown)

/// A thousand workers on paper.
typedef struct crowd {
    int64_t next, count;
    double work_s, end_s;
} crowd;

/// Ten milliseconds on average, from half to one and a half of it.
static bool give_cost(void* user, bt_job* job) {
    crowd* c = user;
    job->run = c->next;
    job->x[0] = 0.01 * (0.5 + (double)(c->next * 7919 % 1000) / 999);
    return c->next++ < c->count;
}

static bt_status take_cost(void* user, const bt_job* job, const bt_landing_result* result) {
    crowd* c = user;
    (void)job;
    c->work_s += result->wall_s;
    c->end_s = fmax(c->end_s, result->end_time_s);
    return BT_OK;
}

static double busy(int workers, int64_t landings) {
    crowd c = {.count = landings};
    const bt_axes axes = {.count = 1};
    const bt_executor executor = {.axes = &axes,
                                  .threads = workers,
                                  .source = give_cost,
                                  .sink = take_cost,
                                  .user = &c,
                                  .backend = &bt_simulated_backend};
    assert_int_equal(bt_executor_run(&executor, NULL), BT_OK);
    BT_ASSERT_NEAR(c.work_s, 0.01 * (double)landings, 1e-9, 0);
    return c.work_s / (workers * c.end_s);
}

/// One worker is never idle; a thousand are kept busy, the last jobs of the batch included.
static void a_thousand_workers_are_kept_busy(void** state) {
    (void)state;
    const double one = busy(1, 1000), thousand = busy(1000, 200000);
    assert_true(one > 0.99 && one <= 1);
    assert_true(thousand > 0.95 && thousand <= 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_job_goes_through_any_back_end_once),
        cmocka_unit_test(a_stop_leaves_jobs_over_but_none_in_hand),
        cmocka_unit_test(an_error_of_the_sink_ends_the_batch),
        cmocka_unit_test(an_error_of_the_back_end_is_said),
        cmocka_unit_test(a_thousand_workers_are_kept_busy),
        MODEL(impossible_numbers_are_failed_landings_with_key_and_limit),
        MODEL(inertia_is_accepted_up_to_the_limit_named),
        MODEL(a_stopped_landing_is_no_result),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

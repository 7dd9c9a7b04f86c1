/// What programs and clusters read: status.json, and the scripts of --slurm, run here by hand.
#include "cli_fixture.h"

#include <sys/stat.h>

/// A coarse cable, so that a landing takes ten milliseconds.
#define COARSE                                                                                     \
    REFERENCE " --set deck.cable.mesh.fine_length='0.2 m' --set "                                  \
              "deck.cable.mesh.medium_length='0.3 m' --set deck.cable.mesh.coarse_length='0.6 m' " \
              "--set campaign.samples=60 --set campaign.unsure=0"

/// The line of a key in a JSON object, its comma left out.
static void value_of(const char* json, const char* key, char value[64]) {
    char wanted[64];
    snprintf(wanted, sizeof wanted, "\"%s\": ", key);
    const char* at = strstr(json, wanted);
    if (!at)
        fail_msg("no \"%s\" in %s", key, json);
    at += strlen(wanted);
    snprintf(value, 64, "%.*s", (int)strcspn(at, ",\n"), at);
}

static void status_json_says_what_campaign_status_says(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "campaign " COARSE " -q -o %/study"), 0);
    char* file = read_text(f, "study/status.json");
    assert_int_equal(bolter(f, "campaign status " COARSE " --json -o %/study"), 0);
    static const char* const keys[] = {"done",     "wanted",     "failed", "left_s",
                                       "estimate", "half_width", "content"};
    for (size_t k = 0; k < sizeof keys / sizeof *keys; ++k) {
        char stored[64], asked[64];
        value_of(file, keys[k], stored);
        value_of(f->out, keys[k], asked);
        assert_string_equal(stored, asked);
    }
    char text[64];
    value_of(file, "wanted", text);
    assert_string_equal(text, "60");
    value_of(file, "rate_per_s", text);
    assert_true(atof(text) > 0);
    // 95 % of 60 landings: a known width, never none
    value_of(file, "half_width", text);
    assert_true(atof(text) > 0.02 && atof(text) < 0.14);
    free(file);
}

/// Runs a script of the directory "jobs" as a task of an array.
static int run_script(const fixture* f, const char* name, int task) {
    char command[4096];
    snprintf(command, sizeof command,
             "cd '%s/jobs' && SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=%d ./%s >'%s/log' 2>&1",
             f->directory, task, name, f->directory);
    return WEXITSTATUS(system(command));
}

static void the_scripts_give_the_ledger_of_one_run(void** state) {
    fixture* f = *state;
    char whole[64], merged[64];
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/jobs --parts 3"), 0);
    assert_has(f->out, "submit.sh");
    char* landings = read_text(f, "jobs/landings.sh");
    assert_has(landings, "#SBATCH --array=1-3\n");
    assert_has(landings, "#SBATCH --requeue\n");
    free(landings);
    for (int task = 1; task <= 3; ++task)
        assert_int_equal(run_script(f, "landings.sh", task), 0);
    assert_int_equal(run_script(f, "landings.sh", 2), 0); // requeued when it was done
    assert_int_equal(
        bolter(f, "campaign merge %/jobs/study.yaml %/jobs/part-*/campaign.sqlite -o %/merged -q"),
        0);
    assert_int_equal(bolter(f, "campaign status " COARSE " --json -o %/merged"), 0);
    value_of(f->out, "content", merged);
    assert_int_equal(bolter(f, "campaign " COARSE " --json -o %/whole"), 0);
    value_of(f->out, "content", whole);
    assert_string_equal(merged, whole);
}

static void scripts_that_may_have_been_edited_stay(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/jobs -q"), 0);
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/jobs -q"), 5);
    assert_has(f->err, "may have been edited");
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/x --parts 0"), 2);
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/x --parts 1001"), 2);
    assert_int_equal(bolter(f, "campaign " COARSE " --slurm %/x --shard 1/2"), 2);
    assert_int_equal(bolter(f, "campaign " COARSE " --parts 2"), 2);
    assert_false(exists(f, "x"));
}

/// What comes two minutes before the end of the time: the task ends in order and asks to be
/// queued again.
static void a_task_at_the_end_of_its_time_is_queued_again(void** state) {
    fixture* f = *state;
    assert_int_equal(
        bolter(f, "campaign " COARSE " --set campaign.samples=100000 --slurm %/jobs --parts 1 -q"),
        0);
    write_file(f, "scontrol", "#!/bin/sh\necho \"$@\" >requeued\n");
    char command[4096];
    snprintf(command, sizeof command,
             "cd '%s/jobs' && chmod +x ../scontrol && export SLURM_ARRAY_JOB_ID=7 "
             "SLURM_ARRAY_TASK_ID=1 PATH=\"$PWD/..:$PATH\" && { ./landings.sh >log 2>&1 & } && "
             "task=$! && until [ -s part-1/campaign.sqlite ]; do sleep 0.1; done && sleep 1 && "
             "kill -USR1 $task && wait $task; test $? -eq 130",
             f->directory);
    assert_int_equal(system(command), 0);
    char* requeued = read_text(f, "jobs/requeued");
    assert_string_equal(requeued, "requeue 7_1\n");
    free(requeued);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(status_json_says_what_campaign_status_says),
        TEST(the_scripts_give_the_ledger_of_one_run),
        TEST(scripts_that_may_have_been_edited_stay),
        TEST(a_task_at_the_end_of_its_time_is_queued_again),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

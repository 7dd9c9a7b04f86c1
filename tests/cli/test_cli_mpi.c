/// Ranks of mpirun: the same ledger as one process, whatever happens to them. Skipped where this
/// bolter has no MPI.
#include "cli_fixture.h"

#include <signal.h>
#include <time.h>

/// A coarse cable, so that a landing takes ten milliseconds.
#define COARSE                                                                                     \
    REFERENCE " --set deck.cable.mesh.fine_length='0.2 m' --set "                                  \
              "deck.cable.mesh.medium_length='0.3 m' --set deck.cable.mesh.coarse_length='0.6 m' " \
              "--set campaign.unsure=0"

/// `mpirun` that starts anywhere: as root, on few cores, without a terminal.
static int prepare(void** state) {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    return setup(state);
}

static bool no_mpi(void) {
#ifdef __SANITIZE_ADDRESS__
    return true; // the leaks of MPI itself would be reported
#else
    const char* program = getenv("BOLTER");
    char command[4096];
    snprintf(command, sizeof command,
             "command -v mpirun >/dev/null && '%s' --version --verbose | grep -q '^mpi  *Open'",
             program ? program : "build/bolter");
    return system(command) != 0;
#endif
}

/// Runs `mpirun OPTIONS bolter ARGUMENTS`.
static int mpirun(fixture* f, const char* options, const char* arguments) {
    const char* program = getenv("BOLTER");
    char command[4096];
    snprintf(command, sizeof command, "mpirun %s '%s'", options,
             program ? program : "build/bolter");
    char* before = program ? strdup(program) : NULL;
    // the fixture quotes the program: mpirun stands in front through a script
    char script[4096];
    FILE* out = fopen(toy_path(script, f->directory, "mpi"), "w");
    fprintf(out, "#!/bin/sh\nexec %s \"$@\"\n", command);
    fclose(out);
    assert_int_equal(chmod(script, 0700), 0);
    setenv("BOLTER", script, 1);
    const int code = bolter(f, arguments);
    if (before)
        setenv("BOLTER", before, 1);
    else
        unsetenv("BOLTER");
    free(before);
    return code;
}

/// The content of the ledger in a directory, as `campaign status` says it.
static void content(fixture* f, const char* arguments, char text[32]) {
    char line[1024];
    snprintf(line, sizeof line, "campaign status %s --json", arguments);
    assert_int_equal(bolter(f, line), 0);
    const char* at = strstr(f->out, "\"ledger_hash\": \"");
    assert_non_null(at);
    snprintf(text, 17, "%s", at + strlen("\"ledger_hash\": \""));
}

static int64_t done(fixture* f, const char* arguments) {
    char line[1024];
    snprintf(line, sizeof line, "campaign status %s --json", arguments);
    if (bolter(f, line) != 0)
        return 0;
    const char* at = strstr(f->out, "\"done\": ");
    return at ? atoll(at + strlen("\"done\": ")) : 0;
}

static void three_ranks_write_the_ledger_of_one_thread(void** state) {
    fixture* f = *state;
    if (no_mpi())
        skip();
#define SMALL COARSE " --set campaign.samples=120"
    char one[32], three[32];
    assert_int_equal(bolter(f, "campaign " SMALL " --set campaign.threads=1 -q -o %/one"), 0);
    assert_int_equal(mpirun(f, "-n 3", "campaign " SMALL " -o %/three"), 0);
    assert_has(f->out, "120 of 120 landings");
    // only rank 0 prints
    assert_null(strstr(strstr(f->out, "120 of 120") + 1, "120 of 120"));
    content(f, SMALL " -o %/one", one);
    content(f, SMALL " -o %/three", three);
    assert_string_equal(one, three);
}

static void noise_prints_the_same_rows(void** state) {
    fixture* f = *state;
    if (no_mpi())
        skip();
    static const char arguments[] = "noise " COARSE " --samples 12 --variants steps_doubled --json";
    assert_int_equal(bolter(f, arguments), 0);
    char* alone = strdup(f->out);
    assert_int_equal(mpirun(f, "-n 2", arguments), 0);
    // all but the computing times
    for (char *a = strtok(alone, "\n"), *b = f->out; a; a = strtok(NULL, "\n")) {
        const size_t length = strcspn(b, "\n");
        if (!strstr(a, "wall_s"))
            assert_int_equal(strncmp(a, b, length), 0);
        b += length + 1;
    }
    free(alone);
}

static void wrong_use_is_said_once(void** state) {
    fixture* f = *state;
    if (no_mpi())
        skip();
    assert_int_equal(mpirun(f, "-n 3", "campaign no/such/file.yaml"), 5);
    const char* first = strstr(f->err, "no/such/file.yaml");
    assert_non_null(first);
    assert_int_equal(mpirun(f, "-n 3", "campaing"), 2);
    first = strstr(f->err, "unknown verb");
    assert_non_null(first);
    assert_null(strstr(first + 1, "unknown verb"));
}

/// The process of one rank of this test's job; 0: not there.
static int find_rank(const fixture* f, int rank) {
    char command[4096], text[32] = "";
    snprintf(command, sizeof command,
             "for p in /proc/[0-9]*; do grep -qa '%s' $p/cmdline 2>/dev/null && "
             "tr '\\0' '\\n' <$p/environ 2>/dev/null | grep -q '^OMPI_COMM_WORLD_RANK=%d$' && "
             "grep -q '^Name:.*bolter' $p/status && basename $p; done | head -1",
             f->directory, rank);
    FILE* out = popen(command, "r");
    if (!fgets(text, sizeof text, out))
        text[0] = '\0';
    pclose(out);
    return atoi(text);
}

static void wait_ms(long ms) {
    const struct timespec t = {.tv_sec = ms / 1000, .tv_nsec = ms % 1000 * 1000000};
    nanosleep(&t, NULL);
}

#define LONG COARSE " --set campaign.samples=400"

/// Kills a rank in the middle, then completes the campaign: the ledger of an undisturbed one.
static void a_rank_that_dies_costs_nothing_that_was_received(void** state) {
    fixture* f = *state;
    if (no_mpi())
        skip();
    const pid_t job = fork();
    if (job == 0)
        _exit(mpirun(f, "-n 3", "campaign " LONG " -q -o %/killed") & 0xff);
    int victim = 0;
    for (int i = 0; i < 600 && (victim == 0 || done(f, LONG " -o %/killed") < 30); ++i) {
        victim = find_rank(f, 1);
        wait_ms(50);
    }
    assert_true(victim > 0);
    assert_int_equal(kill(victim, SIGKILL), 0);
    int code = 0;
    waitpid(job, &code, 0);
    assert_true(WIFEXITED(code) && WEXITSTATUS(code) != 0);
    const int64_t kept = done(f, LONG " -o %/killed");
    assert_true(kept >= 30 && kept < 400);

    char resumed[32], undisturbed[32];
    assert_int_equal(mpirun(f, "-n 2", "campaign " LONG " -q -o %/killed"), 0);
    assert_int_equal(bolter(f, "campaign " LONG " -q -o %/whole"), 0);
    content(f, LONG " -o %/killed", resumed);
    content(f, LONG " -o %/whole", undisturbed);
    assert_string_equal(resumed, undisturbed);
}

static void a_time_limit_ends_in_order(void** state) {
    fixture* f = *state;
    static const char arguments[] =
        "campaign " COARSE " --set campaign.samples=100000 --time-limit '1 s' -o %/short";
    assert_int_equal(bolter(f, arguments), 130);
    assert_has(f->out, " of 100000 landings");
    assert_true(done(f, COARSE " --set campaign.samples=100000 -o %/short") > 0);
    if (no_mpi())
        skip();
    assert_int_equal(mpirun(f, "-n 2", arguments), 130);
    assert_int_equal(bolter(f, "campaign " COARSE " --time-limit '2 m'"), 2);
    assert_has(f->err, "--time-limit: ");
}

#define MPI_TEST(name) cmocka_unit_test_setup_teardown(name, prepare, teardown)

int main(void) {
    const struct CMUnitTest tests[] = {
        MPI_TEST(three_ranks_write_the_ledger_of_one_thread),
        MPI_TEST(noise_prints_the_same_rows),
        MPI_TEST(wrong_use_is_said_once),
        MPI_TEST(a_rank_that_dies_costs_nothing_that_was_received),
        MPI_TEST(a_time_limit_ends_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

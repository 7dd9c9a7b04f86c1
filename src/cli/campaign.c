#include "base/text.h"
#include "base/units.h"
#include "cli/chain.h"
#include "cli/output.h"
#include "cluster/slurm.h"
#include "report/campaign_status.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { OPTION_SHARD, OPTION_TIME_LIMIT, OPTION_SLURM, OPTION_PARTS };

/// "2/8" -> shard 1 of 8 (counted from 0).
static bool read_shard(const bt_command* command, const char* text, int* shard, int* shards) {
    char first[16] = "";
    double i = 0, n = 0;
    const size_t length = strcspn(text, "/");
    if (length < sizeof first && text[length] == '/') {
        memcpy(first, text, length);
        if (bt_number_parse(first, &i) == BT_OK &&
            bt_number_parse(text + length + 1, &n) == BT_OK && i == floor(i) && n == floor(n) &&
            i >= 1 && i <= n && n <= 1e6) {
            *shard = (int)i - 1;
            *shards = (int)n;
            return true;
        }
    }
    bt_usage_error(command, "--shard: \"%s\" is not of the form i/n with 1 <= i <= n", text);
    return false;
}

/// The rate that another process says in status.json, unless that is more than ten seconds old.
static double rate_of_worker(const bt_chain* chain) {
    static const char key[] = "\"rate_per_s\": ";
    char path[BT_FILE_PATH_MAX], *text = NULL;
    struct stat info;
    double rate = NAN;
    if (bt_study_directory_file(&chain->directory, "status.json", path) != BT_OK ||
        stat(path, &info) != 0 || difftime(time(NULL), info.st_mtime) > 10 ||
        bt_file_read(path, &text, NULL, NULL) != BT_OK)
        return NAN;
    const char* at = strstr(text, key);
    if (at && bt_text_scan_number(at + sizeof key - 1, &rate) == at + sizeof key - 1)
        rate = NAN; // null
    free(text);
    return rate;
}

static bt_status print(bt_chain* chain, int64_t total, const bt_ledger_counts* counts) {
    char path[BT_FILE_PATH_MAX];
    bt_campaign_status status = {.wanted = total,
                                 .done = counts->runs,
                                 .engaged = counts->engaged,
                                 .missed = counts->missed,
                                 .failed = counts->failed,
                                 .rate_per_s = rate_of_worker(chain),
                                 .ledger = path};
    BT_TRY(bt_ledger_hash(chain->ledger, &status.content, &chain->diag));
    BT_TRY(bt_study_directory_file(&chain->directory, BT_LEDGER_NAME, path));
    if (chain->command->json) {
        bt_json json = {.out = stdout};
        bt_campaign_status_write(&json, &status);
        return BT_OK;
    }
    printf("%lld of %lld landings: %lld engaged, %lld missed, %lld failed\n"
           "ledger %s (content %016" PRIx64 ")\n",
           (long long)counts->runs, (long long)total, (long long)counts->engaged,
           (long long)counts->missed, (long long)counts->failed, path, status.content);
    return BT_OK;
}

static bt_status print_state(bt_chain* chain) {
    bt_ledger_counts counts;
    bt_design* design = NULL;
    BT_TRY(bt_ledger_count(chain->ledger, &counts, &chain->diag));
    BT_TRY(bt_design_create(&chain->study, &design, &chain->diag));
    const int64_t total = bt_design_count(design);
    bt_design_destroy(design);
    return print(chain, total, &counts);
}

static bt_status run_all(bt_chain* chain, int shard, int shards) {
    bt_campaign_progress progress;
    const bt_status status = bt_chain_campaign(chain, shard, shards, &progress);
    if (status != BT_OK && status != BT_ERR_INTERRUPTED && status != BT_ERR_FAILED_RUNS)
        return status;
    const bt_status printed = print_state(chain);
    return status == BT_OK ? printed : status;
}

static bt_status merge(bt_chain* chain) {
    const bt_command* command = chain->command;
    for (int i = 1; i < command->word_count; ++i) {
        int64_t added = 0;
        BT_TRY(bt_ledger_merge(chain->ledger, command->words[i], &added, &chain->diag));
        if (!command->quiet && !command->json)
            fprintf(stderr, "%s: %lld landings added\n", command->words[i], (long long)added);
    }
    return print_state(chain);
}

/// Scripts instead of landings.
static bt_status write_slurm(const bt_command* command) {
    const char* parts_text = command->option[OPTION_PARTS];
    const char* directory = command->option[OPTION_SLURM];
    bt_diag diag = bt_stderr_diag();
    int64_t parts = 16;
    if (parts_text && !bt_whole_number(command, "--parts", parts_text, 1, &parts))
        return BT_ERR_ARG;
    if (parts > BT_SLURM_PARTS_MAX)
        return bt_usage_error(command, "--parts: at most %d", (int)BT_SLURM_PARTS_MAX);
    if (!*directory || command->option[OPTION_SHARD] || command->output)
        return bt_usage_error(command, "--slurm DIR goes with neither --shard nor -o");
    char program[BT_FILE_PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length > 0)
        program[length] = '\0';
    else
        snprintf(program, sizeof program, "bolter");
    bt_study study;
    BT_TRY(bt_command_study(command, &study));
    const bt_status status = bt_slurm_write(&study, directory, program, (int)parts, &diag);
    bt_study_destroy(&study);
    if (status == BT_OK && !command->quiet)
        printf("look at %s/landings.sh and results.sh, then run %s/submit.sh\n", directory,
               directory);
    return status;
}

static bt_status run_campaign(const bt_command* typed) {
    const bool status_only = strcmp(typed->words[0], "status") == 0;
    const bool merging = strcmp(typed->words[0], "merge") == 0;
    bt_command command = *typed;
    if (status_only || merging) {
        memmove(command.words, command.words + 1, sizeof command.words - sizeof command.words[0]);
        --command.word_count;
    }
    int shard = 0, shards = 1;
    if (command.word_count < 1 + merging)
        return bt_usage_error(&command, "%s expected",
                              merging ? "STUDY.yaml and at least one ledger" : "STUDY.yaml");
    if (command.word_count > 1 && !merging)
        return bt_usage_error(&command, "\"%s\" is one argument too many", command.words[1]);
    const char* part = command.option[OPTION_SHARD];
    if (part && !read_shard(&command, part, &shard, &shards))
        return BT_ERR_ARG;
    if (command.option[OPTION_PARTS] && !command.option[OPTION_SLURM])
        return bt_usage_error(&command, "--parts goes with --slurm DIR");
    if (command.option[OPTION_SLURM])
        return write_slurm(&command);
    BT_TRY(bt_time_limit(&command, command.option[OPTION_TIME_LIMIT]));

    bt_chain chain;
    bt_status status =
        bt_chain_open(&command, status_only ? BT_LEDGER_READ : BT_LEDGER_CREATE, &chain);
    if (status == BT_OK)
        status = status_only ? print_state(&chain)
                 : merging   ? merge(&chain)
                             : run_all(&chain, shard, shards);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"shard", BT_OPTION + OPTION_SHARD, "i/n", 0,
     "run only part i of n; each part in a directory of its own (-o)", 1},
    {"time-limit", BT_OPTION + OPTION_TIME_LIMIT, "TIME", 0,
     "end in order after this time, '50 min' or '12 h', with exit code 130; run again to go on", 1},
    {"slurm", BT_OPTION + OPTION_SLURM, "DIR", 0,
     "run nothing; write scripts into DIR that run the study on a cluster with Slurm", 1},
    {"parts", BT_OPTION + OPTION_PARTS, "N", 0, "tasks of the job array of --slurm (16)", 1},
    {0},
};

const bt_verb bt_verb_campaign = {
    .name = "campaign",
    .summary = "run the landings of the design that the ledger lacks",
    .arguments = "STUDY.yaml\nstatus STUDY.yaml\nmerge STUDY.yaml LEDGER...",
    .text = "Runs the study's design of experiments into STUDY/campaign.sqlite, one row per "
            "landing. Whatever ended an earlier run (Ctrl-C, a kill, a full disk), only the "
            "missing landings are run: the results are the same to the bit, for any number of "
            "threads.\n\n"
            "`campaign status' says how far it is and may be asked while it runs.\n\n"
            "On several machines: bolter campaign study.yaml --shard 1/4 -o part1, and so on; then "
            "bolter campaign merge study.yaml part*/campaign.sqlite. Or, with MPI, on all of them "
            "at once: mpirun -n 8 bolter campaign study.yaml (docs/clusters.md).",
    .options = options,
    .least_words = 1,
    .most_words = BT_WORDS_MAX,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_campaign,
};

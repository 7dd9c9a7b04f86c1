#include "cli/chain.h"
#include "cli/output.h"
#include "report/page.h"

#include <stdio.h>

/// The ledger may hold more landings than the study now asks for; all of them train the surrogate.
static void print_more(const bt_surrogate* surrogate, const bt_campaign_progress* progress) {
    const int trained = surrogate->scores.train_count + surrogate->scores.holdout_count;
    if (trained > progress->done - progress->failed)
        printf(
            "ledger        %d landings of this and earlier runs; the surrogate is trained on all\n",
            trained);
}

/// report.html, where this build has the page.
static bt_status write_page(bt_chain* chain, bool talk) {
    char path[BT_FILE_PATH_MAX];
    if (!bt_page_available(NULL))
        return BT_OK;
    BT_TRY(bt_study_directory_file(&chain->directory, "report.html", path));
    BT_TRY(bt_command_report(chain->command, &chain->study, path));
    if (talk)
        printf("to look at    %s\n", path);
    return BT_OK;
}

static bt_status run_chain(bt_chain* chain) {
    const bool talk = !chain->command->json;
    bt_campaign_progress progress;
    BT_TRY(bt_chain_campaign(chain, 0, 1, &progress));

    bt_surrogate surrogate;
    BT_TRY(bt_stage_fit(&chain->directory, false, &surrogate, NULL));
    if (talk) {
        printf("campaign      %lld landings: %lld engaged, %lld missed, %lld failed\n",
               (long long)progress.done, (long long)progress.engaged, (long long)progress.missed,
               (long long)progress.failed);
        print_more(&surrogate, &progress);
        bt_surrogate_print(stdout, &surrogate);
        printf("\n");
        fflush(stdout);
    }
    const bt_status status = bt_chain_reliability(chain, false, &surrogate);
    bt_surrogate_destroy(&surrogate);
    if (status != BT_OK)
        return status;
    const bool hint = talk && !chain->command->quiet;
    if (hint)
        printf("\nresults in %s\n", chain->study.directory);
    return write_page(chain, hint);
}

static bt_status run_study(const bt_command* command) {
    bt_chain chain;
    BT_TRY(bt_time_limit(command, command->option[0]));
    bt_status status = bt_chain_open(command, BT_LEDGER_CREATE, &chain);
    if (status == BT_OK)
        status = run_chain(&chain);
    bt_chain_close(&chain);
    return status;
}

static const struct argp_option options[] = {
    {"time-limit", BT_OPTION, "TIME", 0,
     "end in order after this time, '50 min' or '12 h', with exit code 130; run again to go on", 1},
    {0},
};

const bt_verb bt_verb_study = {
    .name = "study",
    .summary = "all of it in order: campaign, fit, reliability",
    .arguments = "STUDY.yaml",
    .text = "Runs the landings of the design, trains the surrogate on them, and prints the "
            "reliability of every condition with its interval. What is up to date is not done "
            "again, so a study that was interrupted goes on where it stopped. Everything is kept "
            "in the study directory: study.yaml, campaign.sqlite, surrogate.model, "
            "reliability.json, report.html.",
    .options = options,
    .least_words = 1,
    .most_words = 1,
    .outputs = BT_OUTPUT_DIRECTORY,
    .run = run_study,
};

/// A campaign with progress, and a look at its misses: runs what the ledger of a study lacks, fits
/// the classifier, and prints how landings were missed.
///
///     campaign STUDY.yaml LANDINGS DIRECTORY
#include <bolter/bolter.h>

#include <stdio.h>
#include <string.h>

static void complain(void* user, const char* text) {
    (void)user;
    fprintf(stderr, "%s\n", text);
}

static bool show(void* user, const bt_campaign_counts* counts) {
    (void)user;
    fprintf(stderr, "\r%lld of %lld landings, %lld missed", (long long)counts->done,
            (long long)counts->total, (long long)counts->missed);
    return true; // false would stop it
}

/// The miss with the smallest margin, and how many there are.
typedef struct misses {
    int count;
    double nearest_m;
    int64_t nearest;
} misses;

static bool look(void* user, const bt_campaign_row* row) {
    misses* m = user;
    if (row->report.failed || row->report.engaged)
        return true;
    if (m->count++ == 0 || row->report.margin_m > m->nearest_m) {
        m->nearest_m = row->report.margin_m;
        m->nearest = row->run;
    }
    return true;
}

int main(int argc, char** argv) {
    bt_case* study = NULL;
    if (argc != 4) {
        fprintf(stderr, "usage: campaign STUDY.yaml LANDINGS DIRECTORY\n");
        return 2;
    }
    if (bt_case_open(argv[1], NULL, 0, complain, NULL, &study) != BT_OK)
        return 1;
    const bt_campaign_def def = {.size = sizeof def, .progress = show};
    const bt_fit_def fit = {.size = sizeof fit};
    bt_fit_report scores = {.size = sizeof scores};
    misses missed = {0};
    bt_status status = bt_case_set_text(study, "campaign.samples", argv[2]);
    if (status == BT_OK)
        status = bt_case_set_directory(study, argv[3]);
    if (status == BT_OK)
        status = bt_case_campaign(study, &def, NULL);
    if (status == BT_OK)
        status = bt_case_ledger(study, look, &missed);
    if (status == BT_OK)
        status = bt_case_fit(study, &fit, &scores);
    if (status == BT_OK)
        printf("\n%d missed, the one with the highest margin is landing %lld, %+.1f mm\n"
               "classifier correct on %d of %d held-out landings\n",
               missed.count, (long long)missed.nearest, 1e3 * missed.nearest_m,
               scores.holdout_correct, scores.holdout_count);
    bt_case_close(study);
    return status == BT_OK ? 0 : 1;
}

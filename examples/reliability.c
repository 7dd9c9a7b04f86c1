/// The reliability of own distributions: changes how landings scatter, runs a small campaign, and
/// prints the probability of engagement of every condition with its interval.
///
///     reliability STUDY.yaml LANDINGS DIRECTORY [PATH TEXT]...
///
/// PATH TEXT as for --set: uncertainty.landing.pitch.sd "0.8 deg"
#include <bolter/bolter.h>

#include <stdio.h>

static void complain(void* user, const char* text) {
    (void)user;
    fprintf(stderr, "%s\n", text);
}

static void print(void* user, const bt_reliability_line* line) {
    (void)user;
    if (line->parameter[0])
        printf("%-26s %8.4g %-5s", line->parameter, line->value, line->unit);
    else
        printf("%-41s", "all as distributed");
    printf(" %.4f [%.4f, %.4f]\n", line->corrected, line->corrected_ci95[0],
           line->corrected_ci95[1]);
}

int main(int argc, char** argv) {
    bt_case* study = NULL;
    if (argc < 4 || argc % 2 != 0) {
        fprintf(stderr, "usage: reliability STUDY.yaml LANDINGS DIRECTORY [PATH TEXT]...\n");
        return 2;
    }
    if (bt_case_open(argv[1], NULL, 0, complain, NULL, &study) != BT_OK)
        return 1;
    const bt_campaign_def campaign = {.size = sizeof campaign};
    const bt_reliability_def def = {.size = sizeof def};
    bt_status status = bt_case_set_text(study, "campaign.samples", argv[2]);
    for (int i = 4; i < argc && status == BT_OK; i += 2)
        status = bt_case_set_text(study, argv[i], argv[i + 1]);
    if (status == BT_OK)
        status = bt_case_set_directory(study, argv[3]);
    if (status == BT_OK)
        status = bt_case_campaign(study, &campaign, NULL);
    if (status == BT_OK)
        status = bt_case_reliability(study, &def, print, NULL);
    bt_case_close(study);
    return status == BT_OK ? 0 : 1;
}

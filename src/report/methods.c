#include "report/methods.h"

#include "base/units.h"

#include <inttypes.h>
#include <string.h>

/// "3 deg" in the unit in which the study gives this input.
static void quantity(const bt_input* input, double value, char* text, size_t size) {
    char number[64];
    const char* unit = "";
    if (*input->typed)
        bt_unit_print_as(value, input->typed, number, sizeof number, &unit);
    else
        bt_unit_print(value, *input->field->unit ? input->field->unit : "1", number, sizeof number);
    snprintf(text, size, "%s%s%s", number, *unit ? " " : "", unit);
}

/// Its distribution by name, mean and the range that holds 95 % of it.
static void write_distribution(FILE* out, const bt_input* input) {
    char mean[96], low[96], high[96];
    const bt_distribution* d = &input->distribution;
    quantity(input, bt_distribution_mean(d), mean, sizeof mean);
    quantity(input, bt_distribution_quantile(d, 0.025), low, sizeof low);
    quantity(input, bt_distribution_quantile(d, 0.975), high, sizeof high);
    fprintf(out, "| `%s` | %s | %s | %s to %s |\n", input->path, bt_distribution_names[d->kind],
            mean, low, high);
}

static void write_inputs(FILE* out, const bt_study* study) {
    fprintf(out, "| input | distribution | mean | 95 %% of it |\n| --- | --- | --- | --- |\n");
    for (int i = 0; i < study->input_count; ++i)
        if (study->inputs[i].random)
            write_distribution(out, &study->inputs[i]);
}

/// How the landings were chosen, by design.
static void write_design(FILE* out, const bt_study* study) {
    static const char* const words[] = {
        [BT_DESIGN_SOBOL] = "a digitally shifted Sobol' sequence over the box of their bounds",
        [BT_DESIGN_LATIN_HYPERCUBE] = "a Latin hypercube over the box of their bounds",
        [BT_DESIGN_FULL_FACTORIAL] = "a full factorial over the box of their bounds",
        [BT_DESIGN_MONTE_CARLO] = "independent draws from their distributions",
        [BT_DESIGN_CONDITIONS] = "shifted Sobol' sequences in the mixture of all conditions",
    };
    fprintf(out, "Their inputs were chosen by %s (seed %lld)", words[study->campaign.design],
            (long long)study->campaign.seed);
    if (study->campaign.design == BT_DESIGN_CONDITIONS && study->campaign.unsure > 0)
        fprintf(out, ", %.0f %% of each round where the classifier was unsure",
                100 * study->campaign.unsure);
    fprintf(out, ".");
}

static void write_classifier(FILE* out, const bt_study* study) {
    fprintf(out,
            "A support-vector classifier with a Gaussian kernel was trained on them, its penalty "
            "and kernel width chosen by %lld-fold cross-validation, %.0f %% of the landings held "
            "out. The probability of engagement was computed for %d conditions from %lld points "
            "each on the classifier, ",
            (long long)study->surrogate.folds, 100 * study->surrogate.holdout,
            study->condition_count, (long long)study->reliability.samples);
    if (study->reliability.high_fidelity_runs > 0)
        fprintf(out, "corrected with %lld fresh landings per condition",
                (long long)study->reliability.high_fidelity_runs);
    else
        fprintf(out, "corrected with the landings of the campaign, each judged by a classifier "
                     "that had not seen it");
    fprintf(out,
            "; the other inputs %s. Intervals are of 95 %%, with the classifier's error in "
            "them.\n\n",
            study->reliability.others == BT_OTHERS_SCATTER ? "scattered about their means"
                                                           : "stayed frozen at their means");
}

void bt_methods_write(FILE* out, const bt_study* study, const bt_ledger_counts* counts,
                      uint64_t content_hash, const char* version) {
    fprintf(out, "# Methods: %s\n\n", study->title);
    fprintf(out,
            "%lld carrier landings were simulated with Bolter %s: a multibody model in three "
            "dimensions of airframe, shock struts, tyres and damped arresting hook on an arresting "
            "cable of lumped masses, after Peng, Yin, Xie, Wei and Nie, Chinese Journal of "
            "Aeronautics 36(1), 2023. ",
            (long long)counts->runs, version);
    write_design(out, study);
    fprintf(out,
            " %lld landings engaged the wire, %lld missed it, and %lld failed numerically and "
            "were left out.",
            (long long)counts->engaged, (long long)counts->missed, (long long)counts->failed);
    fprintf(out, " ");
    write_classifier(out, study);
    write_inputs(out, study);
    fprintf(out,
            "\nEvery parameter with its value stands in `study.yaml`, the results of every landing "
            "in the tables of this file (content hash %016" PRIx64 "), program, libraries and "
            "machine in `versions.txt`. `bolter verify FILE 20` repeats twenty landings to the "
            "bit.\n",
            content_hash);
}

#include "cli/rig_sweep.h"

#include "base/directory.h"
#include "base/text.h"
#include "cli/output.h"
#include "report/sweep_report.h"

#include <string.h>

bt_status bt_rig_only(const bt_command* command, const bt_study* study, bt_rig_kind* kind) {
    char found[128] = "";
    int count = 0;
    for (int k = 0; k < BT_RIG_COUNT; ++k)
        if (study->rig_inputs[k].given) {
            *kind = (bt_rig_kind)k;
            bt_text_append(found, sizeof found, "%s%s", count++ ? ", " : "", bt_rig_keys[k]);
        }
    if (count == 1)
        return BT_OK;
    if (count == 0)
        return bt_usage_error(command, "%s describes no rig: there is no `rigs:' in it",
                              command->words[0]);
    return bt_usage_error(command, "%s describes %d rigs (%s): say which", command->words[0], count,
                          found);
}

static bt_status find_kind(const bt_command* command, const bt_study* study, const char* key,
                           bt_rig_kind* kind) {
    for (int k = 0; k < BT_RIG_COUNT; ++k) {
        char part[64];
        snprintf(part, sizeof part, "rigs.%s.", bt_rig_keys[k]);
        if (strncmp(key, part, strlen(part)) != 0)
            continue;
        *kind = (bt_rig_kind)k;
        if (study->rig_inputs[k].given)
            return BT_OK;
        return bt_usage_error(command, "--key: %s does not describe rigs.%s", command->words[0],
                              bt_rig_keys[k]);
    }
    return bt_rig_only(command, study, kind);
}

static bt_status print_table(const bt_command* command, const bt_study* study,
                             const bt_rig_sweep* sweep, const bt_report_table* table) {
    bt_json json = {.out = stdout};
    if (!command->json) {
        printf("%s: %s over %s\n", bt_rig_keys[sweep->kind], study->title, sweep->key);
        return bt_report_table_print(table, stdout);
    }
    bt_json_begin_object(&json, NULL);
    bt_json_string(&json, "rig", bt_rig_keys[sweep->kind]);
    bt_json_string(&json, "key", sweep->key);
    BT_TRY(bt_report_table_json(table, &json, "rows"));
    bt_json_end_object(&json);
    return BT_OK;
}

static bt_status draw(const bt_command* command, const bt_study* study, const bt_rig_sweep* sweep,
                      bt_diag* diag) {
    char folder[BT_FILE_PATH_MAX], name[160];
    BT_TRY(bt_file_path(folder, study->directory, "figures"));
    BT_TRY(bt_directory_make(folder, diag));
    BT_TRY(bt_rig_sweep_draw(study, sweep, folder, name, diag));
    if (!command->json && !command->quiet)
        printf("figure: %s/%s.png\n", folder, name);
    return BT_OK;
}

static bt_status show(const bt_command* command, const bt_study* study, const bt_rig_sweep* sweep,
                      bt_diag* diag) {
    bt_column columns[BT_RIG_SWEEP_COLUMNS];
    bt_report_table* table = bt_rig_sweep_table(sweep, columns);
    bt_status status = print_table(command, study, sweep, table);
    if (status == BT_OK)
        status = bt_output_table(command, table, diag);
    bt_report_table_destroy(table);
    if (status == BT_OK && bt_output_kind(command->output) != BT_OUTPUT_TABLE)
        status = draw(command, study, sweep, diag);
    return status;
}

bt_status bt_rig_sweep_command(const bt_command* command, const bt_study* study, const char* key,
                               const char* list) {
    bt_diag diag = bt_stderr_diag();
    bt_rig_kind kind;
    bt_rig_sweep sweep;
    BT_TRY(find_kind(command, study, key, &kind));
    BT_TRY(bt_stage_rig_sweep(command->words[0], command->sets, command->set_count, kind, key, list,
                              &sweep, &diag));
    const bt_status status = show(command, study, &sweep, &diag);
    bt_rig_sweep_destroy(&sweep);
    return status;
}

#include "report/result_keys.h"

#include "base/units.h"
#include "landing/view.h"
#include "report/table.h"

enum { RESULTS, CONTACTS, MODES, REMARKS, HISTORIES, TABLES };
static const char* const keys[TABLES] = {"results", "contacts", "modes", "remarks", "histories"};

static const char* const titles[TABLES] = {"Results", "Contacts", "Modes", "Remarks", "Histories"};

static const char* const texts[TABLES] = {
    "Columns of the ledger (those of the second bounce excepted). Numbers with a unit are metrics "
    "of\n`calibrate`, called by their name without it. `land --json` has the three legs as one "
    "object and\nthe bounces as an array.",
    "One row per wire that the hook met: `contacts` of `land --json`, table `contacts` of the "
    "ledger "
    "(with\n`run`).",
    "How the hook caught the cable or missed it.",
    "States at the edge of what the model describes: `remarks` of `land --json`, column `remarks` "
    "of the\nledger (`what element time`, in s, separated by `; `).",
    "Columns of `land -o x.csv` and of the curves of a calibration; `x.h5` has the same in groups, "
    "the\nparts of a row side by side.",
};

static const bt_column with_unit[] = {
    {.name = "name", .head = "name", .unit = ""},
    {.name = "unit", .head = "unit", .unit = ""},
    {.name = "meaning", .head = "meaning", .unit = ""},
};
static const bt_column with_element[] = {
    {.name = "what", .head = "what", .unit = ""},
    {.name = "element", .head = "element", .unit = ""},
    {.name = "meaning", .head = "meaning", .unit = ""},
};
static const bt_column plain[] = {
    {.name = "name", .head = "name", .unit = ""},
    {.name = "meaning", .head = "meaning", .unit = ""},
};

static void add_texts(bt_report_table* table, const char* const* text, int count) {
    bt_report_table_row(table);
    for (int i = 0; i < count; ++i)
        bt_report_table_text(table, text[i]);
}

static const char* unit_text(const char* token) {
    return bt_unit_text(*token ? token : "1");
}

static bt_report_table* columns(const bt_result_column* all, int count) {
    bt_report_table* table = bt_report_table_create(NULL, with_unit, 3);
    for (int i = 0; i < count; ++i) {
        const bt_result_column* c = &all[i];
        add_texts(table, (const char*[]){c->name, unit_text(c->unit), c->text}, 3);
    }
    return table;
}

static bt_report_table* results(void) {
    return columns(bt_result_columns, bt_result_column_count);
}

static bt_report_table* contacts(void) {
    return columns(bt_contact_columns, bt_contact_column_count);
}

static bt_report_table* modes(void) {
    bt_report_table* table = bt_report_table_create(NULL, plain, 2);
    for (int i = 0; i < BT_MODE_COUNT; ++i)
        add_texts(table, (const char*[]){bt_mode_name((bt_mode)i), bt_mode_text((bt_mode)i)}, 2);
    return table;
}

static bt_report_table* remarks(void) {
    bt_report_table* table = bt_report_table_create(NULL, with_element, 3);
    for (int i = 0; i < BT_REMARK_COUNT; ++i) {
        const bt_remark_info* r = &bt_remark_table[i];
        add_texts(table, (const char*[]){r->what, r->element, r->text}, 3);
    }
    return table;
}

static bt_report_table* histories(void) {
    bt_report_table* table = bt_report_table_create(NULL, with_unit, 3);
    for (int i = 0; i < bt_view_column_count; ++i) {
        const bt_view_column* c = &bt_view_columns[i];
        add_texts(table, (const char*[]){c->name, unit_text(c->unit), c->text}, 3);
    }
    return table;
}

static bt_report_table* make(int which) {
    static bt_report_table* (*const makers[TABLES])(void) = {results, contacts, modes, remarks,
                                                             histories};
    return makers[which]();
}

bt_status bt_result_keys_markdown(FILE* out) {
    bt_status status = BT_OK;
    fputs("# What a landing gives\n\nMade by `bolter keys --results` from the tables that the "
          "program itself uses. SI throughout.\n",
          out);
    for (int i = 0; i < TABLES && status == BT_OK; ++i) {
        bt_report_table* table = make(i);
        fprintf(out, "\n## %s\n\n%s\n\n", titles[i], texts[i]);
        status = bt_report_table_markdown(table, out);
        bt_report_table_destroy(table);
    }
    return status;
}

bt_status bt_result_keys_json(FILE* out) {
    bt_status status = BT_OK;
    bt_json json = {.out = out};
    bt_json_begin_object(&json, NULL);
    for (int i = 0; i < TABLES && status == BT_OK; ++i) {
        bt_report_table* table = make(i);
        status = bt_report_table_json(table, &json, keys[i]);
        bt_report_table_destroy(table);
    }
    bt_json_end_object(&json);
    return status;
}

/// Report, landing pages, ParaView and the paper beside the study, by their verbs.
#include "cli_fixture.h"

static bool without_page(const fixture* f) {
    return strstr(f->err, "built without its report page") != NULL;
}

static void report_needs_no_ledger(void** state) {
    fixture* f = *state;
    const int code = bolter(f, "report " REFERENCE " -o %/r.html");
    if (without_page(f)) {
        assert_int_equal(code, 3);
        skip();
    }
    assert_int_equal(code, 0);
    assert_has(f->out, "/r.html\n");
    char* page = read_text(f, "r.html");
    assert_has(page, "the study's own landing");
    assert_has(page, "\"bounces\": [{");
    assert_has(page, "\"path\": \"aircraft.mass\"");
    assert_true(strlen(page) < 4000000);
    free(page);
}

static void a_page_of_the_users_stays(void** state) {
    fixture* f = *state;
    write_file(f, "mine.html", "<p>mine");
    const int code = bolter(f, "land " REFERENCE " -o %/mine.html");
    if (without_page(f))
        skip();
    assert_int_equal(code, 5);
    char* page = read_text(f, "mine.html");
    assert_string_equal(page, "<p>mine");
    free(page);
    write_file(f, "mine.pvd", "mine");
    assert_int_equal(bolter(f, "land " REFERENCE " -o %/mine.pvd"), 5);
    page = read_text(f, "mine.pvd");
    assert_string_equal(page, "mine");
    free(page);
}

/// The numbers that the reference study was calibrated to, and what it has no results for.
static void paper_beside_the_reference(void** state) {
    fixture* f = *state;
    assert_int_equal(bolter(f, "paper " REFERENCE " -o %/paper.csv"), 0);
    char* table = read_text(f, "paper.csv");
    assert_has(table, "where,paper,ours,difference,agrees,why\n");
    int agree = 0;
    for (const char* at = table; (at = strstr(at, ",true,")); ++at)
        ++agree;
    assert_int_equal(agree, 10); // Tables 1 and 2, Figs. 14 to 16
    assert_has(table, "not computed");
    free(table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(report_needs_no_ledger),
        TEST(a_page_of_the_users_stays),
        TEST(paper_beside_the_reference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

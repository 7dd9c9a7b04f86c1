#include "near.h"

#include "base/text.h"
#include "base/units.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

/// Typed text, token, value in SI: equal to the bit.
static void assert_reads(const char* text, const char* token, double want) {
    double got = NAN;
    char why[256] = "";
    const bt_status status = bt_unit_parse(text, token, &got, why, sizeof why);
    if (status != BT_OK)
        fail_msg("\"%s\" as %s: %s", text, token, why);
    if (memcmp(&got, &want, sizeof got) != 0)
        fail_msg("\"%s\" as %s: %.17g, expected %.17g", text, token, got, want);
}

static void assert_refused(const char* text, const char* token, const char* want) {
    double got = 12345;
    char why[256] = "";
    assert_int_equal(bt_unit_parse(text, token, &got, why, sizeof why), BT_ERR_INPUT);
    assert_string_equal(why, want);
    assert_true(got == 12345); // untouched
}

static void every_unit_is_one_exact_factor(void** state) {
    (void)state;
    static const struct {
        const char *text, *token;
        double value;
    } rows[] = {
        {"2 m", "m", 2},
        {"400 mm", "m", 0.4},
        {"36.5 mm", "m", 0.0365},
        {"7 cm", "m", 0.07},
        {"1.5 km", "m", 1500},
        {"3 um", "m", 3e-6},
        {"1 in", "m", 0.0254},
        {"10 ft", "m", 3.048},
        {"1 nmi", "m", 1852},
        {"3 ms", "s", 0.003},
        {"20 us", "s", 20e-6},
        {"2 min", "s", 120},
        {"1 h", "s", 3600},
        {"250 g", "kg", 0.25},
        {"22 t", "kg", 22000},
        {"1 lb", "kg", 0.45359237},
        {"48531 lb", "kg", 48531 * 45359237.0 / 1e8},
        {"24 kN", "N", 24000},
        {"1 MN", "N", 1e6},
        {"1 lbf", "N", 4.4482216152605},
        {"1 kip", "N", 4448.2216152605},
        {"6.5 MPa", "Pa", 6.5e6},
        {"1 GPa", "Pa", 1e9},
        {"101.325 kPa", "Pa", 101325},
        {"18 bar", "Pa", 18e5},
        {"1 atm", "Pa", 101325},
        {"36 km/h", "mps", 10},
        {"90 kn", "mps", 46.3},
        {"1 ft/s", "mps", 0.3048},
        {"600 ft/min", "mps", 3.048},
        {"180 deg", "rad", M_PI},
        {"-5 mrad", "rad", -0.005},
        {"1 rpm", "radps", M_PI / 30},
        {"180 deg/s", "radps", M_PI},
        {"375 mm^2", "m2", 0.000375},
        {"1 in^2", "m2", 0.00064516},
        {"1 ft^2", "m2", 0.09290304},
        {"3 L", "m3", 0.003},
        {"600 cm^3", "m3", 600e-6},
        {"5 mL", "m3", 5e-6},
        {"1 in^3", "m3", 1.6387064e-5},
        {"20 kN/m", "Npm", 20000},
        {"3 N/mm", "Npm", 3000},
        {"20 MN/m", "Npm", 2e7},
        {"5e8 N/m^2", "Npm2", 5e8},
        {"1 N/mm^2", "Npm2", 1e6},
        {"2.63e9 N/m^1.5", "Npm15", 2.63e9},
        {"20 kN m", "Nm", 20000},
        {"20 kN m/rad", "Nmprad", 20000},
        {"800 N m s/rad", "Nmsprad", 800},
        {"227.4 kg m^2", "kgm2", 227.4},
        {"5.536 kg/m", "kgpm", 5.536},
        {"860 kg/m^3", "kgpm3", 860},
        {"0.86 g/cm^3", "kgpm3", 860},
        {"4695 N s^2/m^2", "Ns2pm2", 4695},
        {"150 N m^2", "Nm2", 150},
        {"255 N s", "Ns", 255},
        {"6 N m^2 s", "Nm2s", 6},
        {"0.8 s/m", "spm", 0.8},
        {"9.80665 m/s^2", "mps2", 9.80665},
        {"2 kJ", "J", 2000},
        {"50 Hz", "ps", 50},
        {"50 1/s", "ps", 50},
        {"12", "1", 12},
        {"9 lbm", "kg", 9 * 45359237 / 1e8},
        {"3 kgf", "N", 3 * 980665 / 1e5},
        {"7 daN", "N", 70},
        {"1013 mbar", "Pa", 101300},
        {"1013 hPa", "Pa", 101300},
        {"580 cc", "m3", 580e-6},
        {"2 dm^3", "m3", 2e-3},
        {"10 inch", "m", 0.254},
        {"7 fps", "mps", 7 * 3048 / 1e4},
        {"7700 lbs", "kg", 7700 * 45359237.0 / 1e8},
        {"10 ft/sec", "mps", 3.048},
        {"203 cu in", "m3", 203 * 16387064.0 / 1e12},
        {"203 cu. in", "m3", 203 * 16387064.0 / 1e12},
        {"4 sq ft", "m2", 4 * 9290304.0 / 1e8},
        {"135 kt", "mps", 135 * 1852 / 3600.0},
        {"135 kts", "mps", 135 * 1852 / 3600.0},
        {"760 mmHg", "Pa", 760 * 133322387415.0 / 1e9},
        {"1 gal", "m3", 3785411784 / 1e12},
        {"20 N\u00b7m", "Nm", 20},
        {"20 N.m", "Nm", 20},
        {"20 lbf-ft", "Nm", 20 * (44482216152605.0 * 3048) / 1e17},
        {"3 m\u00b7s-1", "mps", 3},
        {"3 m s-1", "mps", 3},
        {"9.81 m/s\u00b2", "mps2", 9.81},
        {"60 mph", "mps", 60 * 1609344 / 3600e3},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i)
        assert_reads(rows[i].text, rows[i].token, rows[i].value);
}

static void derived_imperial_units_follow_from_their_definitions(void** state) {
    (void)state;
    double psi, slug, lbf_per_in;
    char why[256];
    assert_int_equal(bt_unit_parse("1 psi", "Pa", &psi, why, sizeof why), BT_OK);
    assert_int_equal(bt_unit_parse("1 slug", "kg", &slug, why, sizeof why), BT_OK);
    assert_int_equal(bt_unit_parse("1 lbf/in", "Npm", &lbf_per_in, why, sizeof why), BT_OK);
    BT_ASSERT_NEAR(psi, 6894.757293168361, 4e-16, 0);
    BT_ASSERT_NEAR(slug, 14.593902937206365, 4e-16, 0);
    BT_ASSERT_NEAR(lbf_per_in, 175.12683524647635, 4e-16, 0);
}

static void a_unit_may_be_written_in_several_ways(void** state) {
    (void)state;
    assert_reads(" 3.6  m/s ", "mps", 3.6);
    assert_reads("3.6m/s", "mps", 3.6);
    assert_reads("+.5e1 m", "m", 5);
    assert_reads("5. m", "m", 5);
    assert_reads("2 m2", "m2", 2);
    assert_reads("2 N*m^2", "Nm2", 2);
    assert_reads("2 N m m", "Nm2", 2);
    assert_reads("2 N/(m/s)", "Nspm", 2);
    assert_reads("2 N/(m s^-1)", "Nspm", 2);
    assert_reads("2 m/s/s", "mps2", 2);
    assert_reads("2 1/(m)^-1", "m", 2);
    assert_reads("7.5e-2 MN m/rad", "Nmprad", 75000);
}

static void what_is_no_value_is_refused_with_what_would_do(void** state) {
    (void)state;
    const char* pa = "use Pa, kPa, MPa, bar, mbar or psi";
    char want[256];
    static const struct {
        const char *text, *what;
    } rows[] = {
        {"18 foo", "has no known unit"},
        {"18 pa", "has no known unit (did you mean \"Pa\"?)"},
        {"18 KPA", "has no known unit (did you mean \"kPa\"?)"},
        {"18 lbs/in^2", "has a unit of another dimension (did you mean \"lbf/in^2\"?)"},
        {"18 N/m m", "has no known unit"},
        {"18 Pa^", "has no known unit"},
        {"18 (Pa", "has no known unit"},
        {"18 Pa)", "has no known unit"},
        {"18 N/m^0.3", "has no known unit"},
        {"18 Pa 7", "has no known unit"},
        {"18 N/", "has no known unit"},
        {"3.6 m/s", "has a unit of another dimension"},
        {"1.8", "has no unit"},
        {"3,6 MPa", "is not a number: write the decimal point as \".\""},
        {"3,6", "is not a number: write the decimal point as \".\""},
        {"nan Pa", "is not a finite number"},
        {"-.inf", "is not a finite number"},
        {"1e999 Pa", "is not a finite number"},
        {"1e308 MPa", "is not a finite number"},
        {"", "is not a number"},
        {"MPa", "is not a number"},
        {"0x10 Pa", "has no known unit"},
        {"- 5 Pa", "is not a number"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        snprintf(want, sizeof want, "\"%s\" %s; %s", rows[i].text, rows[i].what, pa);
        assert_refused(rows[i].text, "Pa", want);
    }
    snprintf(
        want, sizeof want,
        "\"30 psig\" tells gauge from absolute pressure, which means nothing here: leave out its "
        "last letter; %s",
        pa);
    assert_refused("30 psig", "Pa", want);
    assert_refused("7 kg", "1", "\"7 kg\" is wanted without a unit; use a plain number");
    assert_refused("7", "foo", "unit token \"foo\" is not in the table");
}

static void gauge_pressures_become_what_the_key_means(void** state) {
    (void)state;
    const double psi275 = 275 * (44482216152605.0 / 64516e5);
    double got;
    char why[256];
    assert_int_equal(bt_unit_parse("275 psig", "Pa_absolute", &got, why, sizeof why), BT_OK);
    BT_ASSERT_NEAR(got, psi275 + 101325, 1e-15, 0);
    assert_int_equal(bt_unit_parse("275 psia", "Pa_absolute", &got, why, sizeof why), BT_OK);
    BT_ASSERT_NEAR(got, psi275, 1e-15, 0);
    assert_int_equal(bt_unit_parse("275 psig ", "Pa_gauge", &got, why, sizeof why), BT_OK);
    BT_ASSERT_NEAR(got, psi275, 1e-15, 0);
    assert_reads("10 bara", "Pa_gauge", 10e5 - 101325);
    assert_reads("10 barg", "Pa_absolute", 10e5 + 101325);
    assert_reads("10 bar", "Pa_absolute", 10e5);
    assert_reads("10 bar", "Pa_gauge", 10e5);
}

static void what_was_meant_is_said_only_where_it_fits(void** state) {
    (void)state;
    assert_refused(
        "7700 lb", "N",
        "\"7700 lb\" has a unit of another dimension (did you mean \"lbf\"?); use N, daN, "
        "kN, MN, kgf, lbf or kip");
    assert_refused("7 MPA", "m", "\"7 MPA\" has no known unit; use m, mm, cm, in or ft");
    assert_refused("3 sq in2", "m2",
                   "\"3 sq in2\" has no known unit; use m^2, cm^2, mm^2, in^2 or ft^2");
}

static void an_angle_is_never_taken_for_a_number_or_a_moment_for_a_stiffness(void** state) {
    (void)state;
    assert_refused("52", "rad", "\"52\" has no unit; use deg, rad or mrad");
    assert_refused("3 1/s", "radps",
                   "\"3 1/s\" has a unit of another dimension; use rad/s, deg/s or rpm");
    assert_refused("3 N m", "Nmprad",
                   "\"3 N m\" has a unit of another dimension; use N m/rad, kN m/rad, N m/deg or "
                   "lbf ft/rad");
}

static void printed_values_read_back_to_the_same_bits(void** state) {
    (void)state;
    uint64_t bits = 88172645463325252u;
    for (int i = 0; i < 20000; ++i) {
        bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17; // Marsaglia's xorshift
        double value;
        memcpy(&value, &bits, sizeof value);
        if (!isfinite(value))
            continue;
        char text[128];
        bt_unit_print(value, "mps", text, sizeof text);
        assert_reads(text, "mps", value);
    }
    char text[128];
    bt_unit_print(3.6, "mps", text, sizeof text);
    assert_string_equal(text, "3.6 m/s");
    static const struct {
        double value;
        const char* text;
    } rows[] = {{24000, "24000 m/s"},       {999999, "999999 m/s"}, {6.5e6, "6.5e6 m/s"},
                {1e-5, "1e-5 m/s"},         {0.0365, "0.0365 m/s"}, {1e100, "1e100 m/s"},
                {-1.25e-7, "-1.25e-7 m/s"}, {10, "10 m/s"},         {100000, "100000 m/s"}};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        bt_unit_print(rows[i].value, "mps", text, sizeof text);
        assert_string_equal(text, rows[i].text);
    }
    bt_unit_print(-0.0, "1", text, sizeof text);
    assert_string_equal(text, "-0");
}

static void values_print_in_the_unit_that_was_typed(void** state) {
    (void)state;
    char text[64];
    const char* unit;
    bt_unit_print_as(M_PI / 6, " 90 deg", text, sizeof text, &unit);
    assert_string_equal(text, "30");
    assert_string_equal(unit, "deg");
    bt_unit_print_as(0.25, "7 foo", text, sizeof text, &unit);
    assert_string_equal(text, "0.25");
    assert_string_equal(unit, "");
}

static void reading_does_not_depend_on_the_locale(void** state) {
    (void)state;
    static const char* const commas[] = {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8", "fr_FR"};
    for (size_t i = 0; i < sizeof commas / sizeof commas[0]; ++i)
        if (setlocale(LC_ALL, commas[i]))
            break;
    assert_reads("3.6 m/s", "mps", 3.6);
    char text[64];
    bt_unit_print(3.6, "mps", text, sizeof text);
    assert_string_equal(text, "3.6 m/s");
    setlocale(LC_ALL, "C");
}

static void any_text_is_read_or_refused_and_never_read_as_non_finite(void** state) {
    (void)state;
    static const char letters[] = "0123456789+-.,eE mkgNPasrdp/^*()1";
    unsigned seed = 7;
    for (int i = 0; i < 50000; ++i) {
        char text[24], why[128];
        const int length = rand_r(&seed) % (int)(sizeof text - 1);
        for (int k = 0; k < length; ++k)
            text[k] = letters[rand_r(&seed) % (int)(sizeof letters - 1)];
        text[length] = '\0';
        double value = 0;
        if (bt_unit_parse(text, "Npm", &value, why, sizeof why) == BT_OK)
            assert_true(isfinite(value));
        if (bt_number_parse(text, &value) == BT_OK)
            assert_true(isfinite(value));
    }
}

static void plain_numbers(void** state) {
    (void)state;
    double value = 0;
    assert_int_equal(bt_number_parse(" -1.5e-3 ", &value), BT_OK);
    assert_true(value == -1.5e-3);
    static const char* const bad[] = {"",    "e5",    "1 2",   "1,5", "nan",
                                      "inf", "1e999", "0x1p3", "--1"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i)
        assert_int_equal(bt_number_parse(bad[i], &value), BT_ERR_INPUT);
}

static void names_are_compared_by_edit_distance(void** state) {
    (void)state;
    assert_int_equal(bt_text_distance("", "abc"), 3);
    assert_int_equal(bt_text_distance("abc", ""), 3);
    assert_int_equal(bt_text_distance("sink_speed", "sink_speed"), 0);
    assert_int_equal(bt_text_distance("sink_sped", "sink_speed"), 1);
    assert_int_equal(bt_text_distance("sikn_speed", "sink_speed"), 1);
    assert_int_equal(bt_text_distance("kitten", "sitting"), 3);
    char long_name[101];
    memset(long_name, 'a', 100);
    long_name[100] = '\0';
    assert_true(bt_text_distance(long_name, long_name) > 60);
}

static void appended_text_is_cut_at_the_end_of_the_buffer(void** state) {
    (void)state;
    char text[8] = "ab";
    bt_text_append(text, sizeof text, "%s", "cd");
    assert_string_equal(text, "abcd");
    bt_text_append(text, sizeof text, "%s", "efghij");
    assert_string_equal(text, "abcdefg");
    bt_text_append(text, sizeof text, "%s", "k");
    assert_string_equal(text, "abcdefg");
}

static void tokens_have_texts(void** state) {
    (void)state;
    assert_string_equal(bt_unit_text("mps2"), "m/s^2");
    assert_string_equal(bt_unit_text("1"), "");
    assert_null(bt_unit_text("furlong"));
}

static void characters_of_documents_read_as_the_plain_ones(void** state) {
    (void)state;
    static const struct {
        const char *text, *token;
        double value;
    } rows[] = {
        {"5500 \u00b5m", "m", 5.5e-3},
        {"5500 \u03bcm", "m", 5.5e-3},
        {"\u22123.5 deg", "rad", -3.5 * M_PI / 180},
        {"3.6\u00a0m/s", "mps", 3.6},
        {"3.6\u202fm/s", "mps", 3.6},
        {"9.81 m/s\u00b2", "mps2", 9.81},
        {"2 N\u00b7m", "Nm", 2},
        {"4 m s\u207b\u00b9", "mps", 4},
        {"375 mm\u00b2", "m2", 375e-6},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; ++i) {
        double value = 0;
        char why[256] = "";
        if (bt_unit_parse(rows[i].text, rows[i].token, &value, why, sizeof why) != BT_OK)
            fail_msg("%s: %s", rows[i].text, why);
        BT_ASSERT_NEAR(value, rows[i].value, 1e-15, 0);
    }
    double number = 0;
    assert_int_equal(bt_number_parse("\u22122", &number), BT_OK);
    assert_true(number == -2);
    char text[40];
    const char* unit = "";
    bt_unit_print_as(-3.5 * M_PI / 180, "\u22123.5\u00a0deg", text, sizeof text, &unit);
    assert_string_equal(text, "-3.5");
    assert_string_equal(unit, "deg");
}

static void what_stands_behind_many_blanks_is_not_cut(void** state) {
    (void)state;
    char text[3000], why[256];
    double value = 0;
    snprintf(text, sizeof text, "3.6 m/s%1500sfoo", "");
    assert_int_equal(bt_unit_parse(text, "mps", &value, why, sizeof why), BT_ERR_INPUT);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(characters_of_documents_read_as_the_plain_ones),
        cmocka_unit_test(what_stands_behind_many_blanks_is_not_cut),
        cmocka_unit_test(every_unit_is_one_exact_factor),
        cmocka_unit_test(derived_imperial_units_follow_from_their_definitions),
        cmocka_unit_test(a_unit_may_be_written_in_several_ways),
        cmocka_unit_test(what_is_no_value_is_refused_with_what_would_do),
        cmocka_unit_test(gauge_pressures_become_what_the_key_means),
        cmocka_unit_test(what_was_meant_is_said_only_where_it_fits),
        cmocka_unit_test(an_angle_is_never_taken_for_a_number_or_a_moment_for_a_stiffness),
        cmocka_unit_test(printed_values_read_back_to_the_same_bits),
        cmocka_unit_test(values_print_in_the_unit_that_was_typed),
        cmocka_unit_test(reading_does_not_depend_on_the_locale),
        cmocka_unit_test(any_text_is_read_or_refused_and_never_read_as_non_finite),
        cmocka_unit_test(plain_numbers),
        cmocka_unit_test(names_are_compared_by_edit_distance),
        cmocka_unit_test(appended_text_is_cut_at_the_end_of_the_buffer),
        cmocka_unit_test(tokens_have_texts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#include "reliability/params.h"

const char* const bt_others_names[] = {"scatter", "frozen", NULL};

#define ROW(kind, name, ...) BT_ROW_##kind(bt_reliability_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(reliability, BT_RELIABILITY_FIELDS, ROW, NULL, "the probability of engagement")

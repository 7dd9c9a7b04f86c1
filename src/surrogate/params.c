#include "surrogate/params.h"

#define ROW(kind, name, ...) BT_ROW_##kind(bt_surrogate_params, name, __VA_ARGS__)
BT_DEFINE_GROUP(surrogate, BT_SURROGATE_FIELDS, ROW, NULL, "the support-vector classifier")

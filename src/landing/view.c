#include "landing/view.h"

#define AT(member) offsetof(bt_landing_view, member)
#define ONE(name, unit, text, member) {name "_" #unit, name, #unit, text, AT(member)},
#define COLUMN_REAL(name, unit, text) ONE(#name, unit, text, name##_##unit)
#define COLUMN_VECTOR(name, unit, text)                                                            \
    ONE(#name "_x", unit, text ": forward", name##_##unit[0])                                      \
    ONE(#name "_y", unit, text ": to port", name##_##unit[1])                                      \
    ONE(#name "_z", unit, text ": up", name##_##unit[2])
#define COLUMN_LEGS(name, unit, text)                                                              \
    ONE("nose_" #name, unit, text ", nose", name##_##unit[BT_LEG_NOSE])                            \
    ONE("left_" #name, unit, text ", left", name##_##unit[BT_LEG_LEFT])                            \
    ONE("right_" #name, unit, text ", right", name##_##unit[BT_LEG_RIGHT])
#define COLUMN_ZONES(name, unit, text)                                                             \
    ONE(#name "_shoe", unit, text ": shoe", name##_##unit[BT_ZONE_SHOE])                           \
    ONE(#name "_point", unit, text ": point", name##_##unit[BT_ZONE_POINT])                        \
    ONE(#name "_throat", unit, text ": throat", name##_##unit[BT_ZONE_THROAT])                     \
    ONE(#name "_arm", unit, text ": arm", name##_##unit[BT_ZONE_ARM])
#define COLUMN(KIND, group, name, unit, text) COLUMN_##KIND(name, unit, text)

const bt_view_column bt_view_columns[] = {BT_VIEW_FIELDS(COLUMN)};
const int bt_view_column_count = sizeof bt_view_columns / sizeof bt_view_columns[0];

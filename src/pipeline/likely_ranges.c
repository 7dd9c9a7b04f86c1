#include "pipeline/likely_ranges.h"

#include <stddef.h>
#include <string.h>

const bt_likely_range bt_likely_ranges[] = {
    {"landing.sink_speed", 0, 0},
    {"landing.horizontal_speed", 0, 0},
    {"landing.pitch", 0, 0},
    {"landing.distance", 0, 0},
    {"deck.cable.supports.first", 0, 0},
    {"deck.cable.supports.height", 0, 0},
    {"deck.cable.supports.stiffness", 20e3, 100e3},
    {"deck.cable.pretension", 10e3, 40e3},
    {"deck.cable.mass", 0, 0},
    {"deck.cable.axial_stiffness", 4.0e7, 6.5e7},
    {"deck.cable.bending_stiffness", 30, 3000},
    {"deck.cable.bending_damping", 0.01, 0.09},
    {"deck.cable.axial_damping", 10, 80},
    {"deck.cable.wheel_friction", 0, 0.8},
    {"deck.cable.deck.restitution", 0.1, 0.5},
    {"deck.cable.deck.friction", 0.2, 0.4},
    {"aircraft.main_gear.half_track", 0, 0},
    {"aircraft.main_gear.station", 0, 0},
    {"aircraft.main_gear.underside", 0, 0},
    {"aircraft.main_gear.tyre.bridging_length", 0, 0.15},
    {"aircraft.hook.pivot_x", 0, 0},
    {"aircraft.hook.pivot_z", 0, 0},
    {"aircraft.hook.length", 0, 0},
    {"aircraft.hook.shank_bending_stiffness", 3e5, 3e7},
    {"aircraft.hook.down_stop", 0, 0},
    {"aircraft.hook.damper_angle", 1.483529864195180, 1.745329251994330}, // 85 to 100 deg
    {"aircraft.hook.damper.precharge", 0, 0},
    {"aircraft.hook.damper.orifice_area", 0, 0},
    {"aircraft.hook.damper.stop_stiffness", 2e6, 1e8},
    {"aircraft.hook.profile.head_angle", 0, 0},
    {"aircraft.hook.profile.lip_height", 0.013, 0.037},
    {"aircraft.hook.deck_contact.stiffness", 8e8, 5e10},
    {"aircraft.hook.deck_contact.dissipation", 0, 0},
    {"aircraft.hook.deck_contact.friction", 0.1, 0.5},
    {"aircraft.hook.cable_contact.friction", 0.1, 0.3},
    {NULL, 0, 0},
};

const bt_likely_range* bt_likely_range_find(const char* path) {
    for (const bt_likely_range* range = bt_likely_ranges; range->path; ++range)
        if (range->low < range->high && strcmp(range->path, path) == 0)
            return range;
    return NULL;
}

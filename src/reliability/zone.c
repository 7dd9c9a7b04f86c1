#include "reliability/zone.h"

#include "landing/wires.h"

#include <math.h>
#include <stddef.h>

static int find_distance(const bt_study* study) {
    const size_t offset =
        offsetof(bt_model_params, landing) + offsetof(bt_landing_params, distance_m);
    for (int i = 0; i < study->input_count; ++i)
        if (study->inputs[i].offset == offset && study->inputs[i].random)
            return i;
    return -1;
}

bt_zones bt_zones_of(const bt_study* study) {
    const bt_deck_params* deck = &study->model.deck;
    const int wires = bt_wires_count(deck);
    bt_zones z = {.input = find_distance(study)};
    if (wires < 2 || z.input < 0)
        return z;
    const bt_distribution* d = &study->inputs[z.input].distribution;
    const double to = bt_wires_position(deck, (int)study->model.landing.distance_to - 1);
    double below = 1; // probability of a distance less than the zone's greatest
    z.count = wires + 1;
    for (int k = 0; k < wires; ++k) {
        z.nearest_m[k] = to - bt_wires_position(deck, k);
        const double less = bt_distribution_cdf(d, z.nearest_m[k]);
        z.share[k] = below - less;
        below = less;
    }
    z.nearest_m[wires] = -INFINITY;
    z.share[wires] = below;
    return z;
}

int bt_zones_find(const bt_zones* zones, double distance_m) {
    int k = 0;
    while (k < zones->count - 1 && distance_m < zones->nearest_m[k])
        ++k;
    return k;
}

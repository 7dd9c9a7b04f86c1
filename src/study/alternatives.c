#include "study/alternatives.h"

#include "base/units.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 64 };

/// A scalar as a positive quantity; false after reporting an error.
static bool read_positive(bt_reader* reader, const bt_node* node, const char* token,
                          double* value) {
    char why[256];
    const char* name = node->key->text;
    if (node->kind != BT_NODE_SCALAR ||
        bt_unit_parse(node->text, token, value, why, sizeof why) != BT_OK)
        bt_reader_error(reader, node->where, "%s: %s", name,
                        node->kind == BT_NODE_SCALAR ? why : "a value is wanted here");
    else if (*value > 0)
        return true;
    else
        bt_reader_error(reader, node->where, "%s: must be above 0", name);
    return false;
}

/// Gives a node another key; false after reporting that this one is there too.
static bool rename_key(bt_reader* reader, bt_document* document, const bt_node* parent,
                       bt_node* node, const char* key) {
    if (bt_node_child(parent, key)) {
        bt_reader_error(reader, node->key->where, "%s: stands in the place of %s; give one of them",
                        node->key->text, key);
        node->refused = true;
        return false;
    }
    bt_node* name = bt_document_node(document, BT_NODE_SCALAR, node->key->where, key, strlen(key));
    if (name)
        node->key = name;
    return name != NULL;
}

/// Puts `key: value` in the place of a node, which keeps its place in the file.
static void put_instead(bt_reader* reader, bt_document* document, const bt_node* parent,
                        bt_node* node, const char* key, double value, const char* token) {
    char text[64];
    bt_unit_print(value, token, text, sizeof text);
    bt_node* by = bt_document_node(document, BT_NODE_SCALAR, node->where, text, strlen(text));
    if (by && rename_key(reader, document, parent, node, key))
        bt_node_replace(node, by);
}

/// "air" of "air_diameter": false for other keys.
static bool is_diameter(const bt_node* node, char area[NAME_SIZE]) {
    static const char ending[] = "_diameter";
    const size_t length = strlen(node->key->text), cut = sizeof ending - 1;
    if (length <= cut || length >= NAME_SIZE || strcmp(node->key->text + length - cut, ending) != 0)
        return false;
    snprintf(area, NAME_SIZE, "%.*s_area", (int)(length - cut), node->key->text);
    return true;
}

static void apply_diameters(bt_reader* reader, bt_document* document, bt_node* node, int depth) {
    char area[NAME_SIZE];
    double d;
    if (!node || node->kind != BT_NODE_MAPPING || depth > BT_DOCUMENT_DEPTH_MAX)
        return;
    for (bt_node* child = node->first; child; child = child->next) {
        if (is_diameter(child, area) && read_positive(reader, child, "m", &d))
            put_instead(reader, document, node, child, area, M_PI / 4 * d * d, "m2");
        apply_diameters(reader, document, child, depth + 1);
    }
}

static void apply_energy(bt_reader* reader, bt_document* document, bt_node* rig) {
    bt_node* energy = bt_node_child(rig, "drop_energy");
    double work, mass;
    char why[256];
    if (!energy || !read_positive(reader, energy, "J", &work))
        return;
    const bt_node* m = bt_node_child(rig, "mass");
    if (!m || m->kind != BT_NODE_SCALAR ||
        bt_unit_parse(m->text, "kg", &mass, why, sizeof why) != BT_OK || !(mass > 0))
        bt_reader_error(reader, energy->key->where,
                        "drop_energy: wants the mass that falls, `mass`");
    else
        put_instead(reader, document, rig, energy, "sink_speed", sqrt(2 * work / mass), "mps");
}

static void apply_former_names(bt_reader* reader, bt_document* document, const bt_node* root) {
    const bt_node* reliability = bt_node_child(root, "reliability");
    bt_node* runs = bt_node_child(reliability, "truth_runs");
    if (runs)
        rename_key(reader, document, reliability, runs, "high_fidelity_runs");
}

void bt_alternatives_apply(bt_reader* reader, bt_document* document, const bt_node* root) {
    apply_former_names(reader, document, root);
    apply_diameters(reader, document, bt_node_child(root, "aircraft"), 0);
    bt_node* rigs = bt_node_child(root, "rigs");
    for (bt_node* rig = rigs && rigs->kind == BT_NODE_MAPPING ? rigs->first : NULL; rig;
         rig = rig->next)
        apply_energy(reader, document, rig);
}

/// One YAML file as a tree of texts with their places. Nothing is interpreted here: "3.6 m/s" and
/// "true" are texts. Anchors, aliases and tags are refused; size and depth are bounded.
#ifndef BT_STUDY_DOCUMENT_H
#define BT_STUDY_DOCUMENT_H

#include "base/diag.h"

#include <stdbool.h>
#include <stddef.h>

enum {
    BT_DOCUMENT_SIZE_MAX = 1 << 20, ///< bytes
    BT_DOCUMENT_DEPTH_MAX = 16,
    BT_DOCUMENT_NODES_MAX = 40000,
    BT_DOCUMENT_KEYS_MAX = 1000,   ///< keys of one mapping
    BT_DOCUMENT_ITEMS_MAX = 10000, ///< items of one sequence
};

typedef enum bt_node_kind { BT_NODE_SCALAR, BT_NODE_SEQUENCE, BT_NODE_MAPPING } bt_node_kind;

typedef struct bt_node {
    bt_node_kind kind;
    bt_where where;
    bool refused;          ///< already reported: not to be read
    struct bt_node* key;   ///< the scalar that names it; NULL outside a mapping
    struct bt_node* first; ///< child; in the order of the file
    struct bt_node* last;
    struct bt_node* next;  ///< sibling
    int count;             ///< children
    struct bt_node* older; ///< every node of a document, newest first
    const char* text;      ///< scalar: its text; "" otherwise. Lives as long as the document
} bt_node;

typedef struct bt_document {
    bt_node* newest; ///< owns all nodes
    int node_count;
} bt_document;

/// Parses a text and gives the node at its top in *root (NULL for an empty text). Nodes belong to
/// the document, which may hold several texts. `where.file` names the text in messages; with line
/// 0 all its nodes have that one place. BT_ERR_INPUT, said in diag; BT_ERR_MEMORY.
/// Refused aliases, anchors and tags count in diag but leave a tree that can be read on.
BT_CHECKED bt_status bt_document_parse(bt_document* document, const char* data, size_t size,
                                       bt_where where, bt_node** root, bt_diag* diag);
void bt_document_destroy(bt_document* document);

/// A new node; NULL when out of memory. `length` bytes of text are copied.
bt_node* bt_document_node(bt_document* document, bt_node_kind kind, bt_where where,
                          const char* text, size_t length);

/// Appends a child; key NULL in a sequence.
void bt_node_append(bt_node* parent, bt_node* key, bt_node* child);

/// Gives a node the content and place of another; its key and its siblings stay.
void bt_node_replace(bt_node* node, const bt_node* by);

/// Takes the child with this key out of a mapping; NULL when there is none (or parent is NULL).
bt_node* bt_node_take(bt_node* parent, const char* key);

/// The child with this key, NULL when there is none (or node is no mapping, or NULL).
bt_node* bt_node_child(const bt_node* node, const char* key);

#endif

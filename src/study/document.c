#include "study/document.h"

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

bt_node* bt_document_node(bt_document* document, bt_node_kind kind, bt_where where,
                          const char* text, size_t length) {
    bt_node* node = calloc(1, sizeof *node + length + 1);
    if (!node)
        return NULL;
    node->kind = kind;
    node->where = where;
    node->text = memcpy(node + 1, text, length); // ends in calloc's zero
    node->older = document->newest;
    document->newest = node;
    ++document->node_count;
    return node;
}

void bt_document_destroy(bt_document* document) {
    for (bt_node* node = document->newest; node;) {
        bt_node* older = node->older;
        free(node);
        node = older;
    }
    *document = (bt_document){0};
}

void bt_node_append(bt_node* parent, bt_node* key, bt_node* child) {
    child->key = key;
    child->next = NULL;
    if (parent->last)
        parent->last->next = child;
    else
        parent->first = child;
    parent->last = child;
    ++parent->count;
}

void bt_node_replace(bt_node* node, const bt_node* by) {
    node->kind = by->kind;
    node->where = by->where;
    node->refused = by->refused;
    node->first = by->first;
    node->last = by->last;
    node->count = by->count;
    node->text = by->text;
}

bt_node* bt_node_child(const bt_node* node, const char* key) {
    for (bt_node* child = node ? node->first : NULL; child; child = child->next)
        if (child->key && strcmp(child->key->text, key) == 0)
            return child;
    return NULL;
}

typedef struct parser {
    yaml_parser_t yaml;
    bt_document* document;
    bt_where where; ///< place of the text; line 0: that of every node too
    bt_diag* diag;
    bt_status status; ///< status of the first thing that stops the parser
} parser;

static bt_where place(const parser* p, yaml_mark_t mark) {
    if (p->where.line == 0)
        return p->where;
    return (bt_where){p->where.file, (int)mark.line + 1, (int)mark.column + 1};
}

static bool stop(parser* p, yaml_mark_t mark, const char* text) {
    bt_diag_add(p->diag, BT_ERROR, place(p, mark), "%s", text);
    p->status = BT_ERR_INPUT;
    return false;
}

static void report_syntax(parser* p) {
    const yaml_parser_t* y = &p->yaml;
    if (y->error == YAML_MEMORY_ERROR) {
        p->status = BT_ERR_MEMORY;
        return;
    }
    p->status = BT_ERR_INPUT;
    const char* problem = y->problem ? y->problem : "unknown error";
    if (y->error == YAML_READER_ERROR) { // no line is known
        bt_diag_add(p->diag, BT_ERROR, (bt_where){p->where.file, 0, 0},
                    "not a text in UTF-8: %s at byte %zu", problem, y->problem_offset);
        return;
    }
    const bool tab = strstr(problem, "cannot start any token") != NULL;
    bt_diag_add(p->diag, BT_ERROR, place(p, y->problem_mark), "not valid YAML: %s%s%s%s", problem,
                y->context ? " " : "", y->context ? y->context : "",
                tab ? "; indent with blanks, not tabs" : "");
}

static bool next_event(parser* p, yaml_event_t* event) {
    if (yaml_parser_parse(&p->yaml, event))
        return true;
    report_syntax(p);
    return false;
}

/// Anchors and tags make nothing better and can make a small file large or a number a text.
static void refuse_properties(parser* p, const yaml_event_t* event, const void* anchor,
                              const void* tag) {
    if (anchor)
        bt_diag_add(p->diag, BT_ERROR, place(p, event->start_mark),
                    "anchors (&%s) are not accepted; write the value where it is needed",
                    (const char*)anchor);
    if (tag)
        bt_diag_add(p->diag, BT_ERROR, place(p, event->start_mark),
                    "tags (%s) are not accepted; the key decides what its value is",
                    (const char*)tag);
}

static bt_node* make_node(parser* p, bt_node_kind kind, const yaml_event_t* event, const char* text,
                          size_t length) {
    if (p->document->node_count >= BT_DOCUMENT_NODES_MAX) {
        stop(p, event->start_mark, "too many values for a study");
        return NULL;
    }
    if (memchr(text, '\0', length)) {
        stop(p, event->start_mark, "a value contains a zero byte");
        return NULL;
    }
    bt_node* node = bt_document_node(p->document, kind, place(p, event->start_mark), text, length);
    if (!node)
        p->status = BT_ERR_MEMORY;
    return node;
}

static bt_node* parse_node(parser* p, const yaml_event_t* event, int depth);

/// The next child of a collection; NULL at its end or when the parser stops.
static bt_node* parse_child(parser* p, int depth) {
    yaml_event_t event;
    if (!next_event(p, &event))
        return NULL;
    bt_node* child = NULL;
    if (event.type != YAML_SEQUENCE_END_EVENT && event.type != YAML_MAPPING_END_EVENT)
        child = parse_node(p, &event, depth);
    yaml_event_delete(&event);
    return child;
}

static bool parse_children(parser* p, bt_node* parent, int depth) {
    for (;;) {
        bt_node* key = NULL;
        bt_node* child = parse_child(p, depth + 1);
        if (!child)
            return p->status == BT_OK;
        if (parent->kind == BT_NODE_MAPPING) {
            key = child;
            if (key->kind != BT_NODE_SCALAR) {
                bt_diag_add(p->diag, BT_ERROR, key->where, "a key must be a plain text");
                p->status = BT_ERR_INPUT;
                return false;
            }
            child = parse_child(p, depth + 1);
            if (!child)
                return false;
        }
        bt_node_append(parent, key, child);
        const int most =
            parent->kind == BT_NODE_MAPPING ? BT_DOCUMENT_KEYS_MAX : BT_DOCUMENT_ITEMS_MAX;
        if (parent->count > most) {
            bt_diag_add(p->diag, BT_ERROR, child->where, "more than %d entries in one place", most);
            p->status = BT_ERR_INPUT;
            return false;
        }
    }
}

static bt_node* parse_collection(parser* p, const yaml_event_t* event, bt_node_kind kind,
                                 int depth) {
    if (depth >= BT_DOCUMENT_DEPTH_MAX) {
        stop(p, event->start_mark, "nested deeper than any study needs");
        return NULL;
    }
    bt_node* node = make_node(p, kind, event, "", 0);
    return node && parse_children(p, node, depth) ? node : NULL;
}

static bt_node* parse_node(parser* p, const yaml_event_t* event, int depth) {
    bt_node* node = NULL;
    switch (event->type) {
    case YAML_SCALAR_EVENT:
        refuse_properties(p, event, event->data.scalar.anchor, event->data.scalar.tag);
        return make_node(p, BT_NODE_SCALAR, event, (const char*)event->data.scalar.value,
                         event->data.scalar.length);
    case YAML_SEQUENCE_START_EVENT:
        refuse_properties(p, event, event->data.sequence_start.anchor,
                          event->data.sequence_start.tag);
        return parse_collection(p, event, BT_NODE_SEQUENCE, depth);
    case YAML_MAPPING_START_EVENT:
        refuse_properties(p, event, event->data.mapping_start.anchor,
                          event->data.mapping_start.tag);
        return parse_collection(p, event, BT_NODE_MAPPING, depth);
    case YAML_ALIAS_EVENT:
        bt_diag_add(p->diag, BT_ERROR, place(p, event->start_mark),
                    "aliases (*%s) are not accepted; write the value where it is needed",
                    (const char*)event->data.alias.anchor);
        node = make_node(p, BT_NODE_SCALAR, event, "", 0);
        if (node)
            node->refused = true;
        return node;
    default:
        stop(p, event->start_mark, "not valid YAML");
        return NULL;
    }
}

/// Stream start, one document at most, stream end.
static void parse_stream(parser* p, bt_node** root) {
    int documents = 0;
    for (bool more = true; more && p->status == BT_OK;) {
        yaml_event_t event;
        if (!next_event(p, &event))
            return;
        switch (event.type) {
        case YAML_STREAM_END_EVENT:
            more = false;
            break;
        case YAML_STREAM_START_EVENT:
        case YAML_DOCUMENT_END_EVENT:
            break;
        case YAML_DOCUMENT_START_EVENT:
            if (++documents > 1)
                stop(p, event.start_mark, "one document per file; a second begins here");
            break;
        default:
            *root = parse_node(p, &event, 0);
        }
        yaml_event_delete(&event);
    }
}

bt_status bt_document_parse(bt_document* document, const char* data, size_t size, bt_where where,
                            bt_node** root, bt_diag* diag) {
    *root = NULL;
    if (size > BT_DOCUMENT_SIZE_MAX) {
        bt_diag_add(diag, BT_ERROR, (bt_where){where.file, 0, 0}, "larger than %d bytes",
                    (int)BT_DOCUMENT_SIZE_MAX);
        return BT_ERR_INPUT;
    }
    if (size >= 3 && memcmp(data, "\xef\xbb\xbf", 3) == 0) { // the mark that some editors write
        data += 3;
        size -= 3;
    }
    parser p = {.document = document, .where = where, .diag = diag, .status = BT_OK};
    if (!yaml_parser_initialize(&p.yaml))
        return BT_ERR_MEMORY;
    yaml_parser_set_input_string(&p.yaml, (const unsigned char*)data, size);
    yaml_parser_set_encoding(&p.yaml, YAML_UTF8_ENCODING);
    parse_stream(&p, root);
    yaml_parser_delete(&p.yaml);
    return p.status;
}

bt_node* bt_node_take(bt_node* parent, const char* key) {
    bt_node* node = bt_node_child(parent, key);
    if (!node)
        return NULL;
    bt_node* before = NULL;
    for (bt_node* child = parent->first; child != node; child = child->next)
        before = child;
    *(before ? &before->next : &parent->first) = node->next;
    if (parent->last == node)
        parent->last = before;
    --parent->count;
    node->next = NULL;
    return node;
}

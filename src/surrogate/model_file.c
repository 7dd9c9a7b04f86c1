#include "surrogate/surrogate.h"

#include "base/directory.h"
#include "base/hash.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// The file, line by line:
//   bolter surrogate 1
//   study HASH
//   training HASH
//   inputs N, then per input: input PATH CENTRE SCALE LEAST GREATEST WEIGHT
//   (no WEIGHT in older files: 1)
//   machine KIND C GAMMA RHO            KIND: svm, constant
//   scores ... (counts)
//   seconds S
//   vectors N, then per support vector: COEF Z_1 ... Z_dims
//   end CHECKSUM                        FNV-1a of every byte before this line
// Numbers that are not counts are hexadecimal floats, written and read here: exact, and
// independent of the locale.

#define FIRST_WORDS "bolter surrogate "
enum { VERSION = 1, NUMBER_SIZE = 32, WORD_MAX = BT_INPUT_MAX + 8 };

static uint64_t checksum(const char* data, size_t size) {
    return bt_hash_bytes(BT_HASH_START, data, size);
}

/* ---- writing ---- */

typedef struct writer {
    char* text;
    size_t used, size;
    bool full; ///< memory ran out
} writer;

static void put(writer* w, const char* text) {
    const size_t length = strlen(text);
    if (w->used + length + 1 > w->size && !w->full) {
        const size_t size = 2 * (w->size + length) + 4096;
        char* grown = realloc(w->text, size);
        w->full = !grown;
        if (grown) {
            w->text = grown;
            w->size = size;
        }
    }
    if (w->full)
        return;
    memcpy(w->text + w->used, text, length + 1);
    w->used += length;
}

static void put_count(writer* w, int64_t count) {
    char text[NUMBER_SIZE];
    snprintf(text, sizeof text, " %" PRId64, count);
    put(w, text);
}

static void put_hash(writer* w, const char* name, uint64_t hash) {
    char text[64];
    snprintf(text, sizeof text, "%s %016" PRIx64 "\n", name, hash);
    put(w, text);
}

/// " -0x1.8p+3": sign, 1 (0 below the normal range), 52 bits of fraction, power of two.
static void put_real(writer* w, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    const int exponent = (int)(bits >> 52 & 0x7ff);
    char text[NUMBER_SIZE];
    snprintf(text, sizeof text, " %s0x%d.%013" PRIx64 "p%+d", bits >> 63 ? "-" : "", exponent > 0,
             bits & 0xfffffffffffffu, exponent > 0 ? exponent - 1023 : -1022);
    put(w, text);
}

static void put_head(writer* w, const bt_surrogate* s) {
    put(w, FIRST_WORDS "1\n");
    put_hash(w, "study", s->study_hash);
    put_hash(w, "training", s->training_hash);
    put(w, "inputs");
    put_count(w, s->dims);
    for (int k = 0; k < s->dims; ++k) {
        put(w, "\ninput ");
        put(w, s->path[k][0] ? s->path[k] : "-");
        put_real(w, s->centre[k]);
        put_real(w, s->scale[k]);
        put_real(w, s->least[k]);
        put_real(w, s->greatest[k]);
        put_real(w, s->weight[k]);
    }
    put(w, s->constant ? "\nmachine constant" : "\nmachine svm");
    put_real(w, s->C);
    put_real(w, s->gamma);
    put_real(w, s->rho);
}

static void put_scores(writer* w, const bt_surrogate_scores* s) {
    const int counts[] = {s->train_count,     s->train_correct,   s->holdout_count,
                          s->holdout_correct, s->confusion[0][0], s->confusion[0][1],
                          s->confusion[1][0], s->confusion[1][1], s->cv_count,
                          s->cv_correct};
    put(w, "\nscores");
    for (size_t i = 0; i < sizeof counts / sizeof *counts; ++i)
        put_count(w, counts[i]);
    put(w, "\nseconds");
    put_real(w, s->seconds);
}

bt_status bt_surrogate_save(const bt_surrogate* surrogate, const char* file, bt_diag* diag) {
    writer w = {0};
    put_head(&w, surrogate);
    put_scores(&w, &surrogate->scores);
    put(&w, "\nvectors");
    put_count(&w, surrogate->sv_count);
    for (int i = 0; i < surrogate->sv_count; ++i) {
        put(&w, "\nv");
        put_real(&w, surrogate->coef[i]);
        for (int k = 0; k < surrogate->dims; ++k)
            put_real(&w, surrogate->sv[i * surrogate->dims + k]);
    }
    put(&w, "\n");
    put_hash(&w, "end", w.full ? 0 : checksum(w.text, w.used));
    const bt_status status = w.full ? BT_ERR_MEMORY : bt_file_write(file, w.text, w.used, diag);
    free(w.text);
    return status;
}

/* ---- reading ---- */

/// A reader of words, line by line. Each function that takes something returns false when it is
/// not there, after saying so; nothing is taken after that.
typedef struct reader {
    const char* file;
    char *at, *end;
    int line;
    char* word[WORD_MAX]; ///< words of the current line
    int count;
    bt_diag* diag;
} reader;

static bool wrong(reader* r, const char* what) {
    bt_diag_add(r->diag, BT_ERROR, (bt_where){r->file, r->line, 1}, "%s", what);
    return false;
}

/// Takes a line that must begin with `name` and have `least` to `count` more words.
static bool take_words(reader* r, const char* name, int least, int count) {
    char text[160];
    char* stop = r->at < r->end ? memchr(r->at, '\n', (size_t)(r->end - r->at)) : NULL;
    ++r->line;
    if (!stop) {
        snprintf(text, sizeof text, "the file ends early: \"%s\" should follow; run fit again",
                 name);
        return wrong(r, text);
    }
    *stop = '\0';
    char* state = NULL;
    r->count = 0;
    for (char* word = strtok_r(r->at, " ", &state); word && r->count < WORD_MAX;
         word = strtok_r(NULL, " ", &state))
        r->word[r->count++] = word;
    r->at = stop + 1;
    if (r->count > least && r->count <= count + 1 && !strcmp(r->word[0], name))
        return true;
    snprintf(text, sizeof text, "\"%s\" with %d values should stand here; the file is damaged",
             name, count);
    return wrong(r, text);
}

/// Takes a line that must begin with `name` and have `count` more words.
static bool take_line(reader* r, const char* name, int count) {
    return take_words(r, name, count, count);
}

static int hex_digit(char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/// What put_real writes, and nothing else.
static bool take_real(reader* r, const char* text, double* value) {
    const uint64_t sign = *text == '-';
    text += sign;
    uint64_t bits = 0;
    bool sound = !strncmp(text, "0x0.", 4) || !strncmp(text, "0x1.", 4);
    const bool normal = sound && text[2] == '1';
    for (int i = 0; i < 13 && sound; ++i) {
        const int digit = hex_digit(text[4 + i]);
        sound = digit >= 0;
        bits = bits << 4 | (uint64_t)(digit & 15);
    }
    sound = sound && text[17] == 'p' && (text[18] == '+' || text[18] == '-');
    int exponent = 0, digits = 0;
    for (const char* p = text + 19; sound && *p; ++p) {
        sound = *p >= '0' && *p <= '9' && ++digits <= 4;
        exponent = 10 * exponent + (*p - '0');
    }
    if (sound && text[18] == '-')
        exponent = -exponent;
    if (!sound || digits == 0 || (normal ? exponent < -1022 || exponent > 1023 : exponent != -1022))
        return wrong(r,
                     "a hexadecimal floating-point number should stand here; the file is damaged");
    bits |= sign << 63 | (normal ? (uint64_t)(exponent + 1023) << 52 : 0);
    memcpy(value, &bits, sizeof bits);
    return true;
}

static bool take_count(reader* r, const char* text, int64_t greatest, int* count) {
    int64_t value = 0;
    bool sound = *text != '\0';
    for (const char* p = text; *p && sound; ++p) {
        sound = *p >= '0' && *p <= '9' && value <= greatest;
        value = 10 * value + (*p - '0');
    }
    if (!sound || value > greatest)
        return wrong(r, "a count should stand here; the file is damaged");
    *count = (int)value;
    return true;
}

static bool take_hash(reader* r, const char* name, uint64_t* hash) {
    if (!take_line(r, name, 1))
        return false;
    *hash = 0;
    bool sound = strlen(r->word[1]) == 16;
    for (int i = 0; i < 16 && sound; ++i) {
        const int digit = hex_digit(r->word[1][i]);
        sound = digit >= 0;
        *hash = *hash << 4 | (uint64_t)(digit & 15);
    }
    return sound || wrong(r, "16 hexadecimal digits should stand here; the file is damaged");
}

/// The first line, the version, and the checksum over the whole.
static bool take_identity(reader* r) {
    const size_t length = strlen(FIRST_WORDS), size = (size_t)(r->end - r->at);
    r->line = 1;
    if (size < length || memcmp(r->at, FIRST_WORDS, length) != 0)
        return wrong(r, "this is not a surrogate written by bolter");
    if (size < length + 2 || r->at[length] != '0' + VERSION || r->at[length + 1] != '\n')
        return wrong(r, "a surrogate of another version of bolter (this one reads version 1); run "
                        "fit again");
    // The last line holds the checksum of all before it.
    const char* last = r->end;
    while (last > r->at && last[-1] == '\n')
        --last;
    while (last > r->at && last[-1] != '\n')
        --last;
    r->line = 0;
    char expected[32];
    snprintf(expected, sizeof expected, "end %016" PRIx64 "\n",
             checksum(r->at, (size_t)(last - r->at)));
    if (strncmp(last, "end ", 4) != 0)
        return wrong(r, "the file ends early; run fit again");
    if ((size_t)(r->end - last) != strlen(expected) ||
        memcmp(last, expected, strlen(expected)) != 0)
        return wrong(r,
                     "the checksum does not agree: the file was changed or damaged; run fit again");
    r->at += length + 2;
    r->line = 1;
    return true;
}

static bool take_inputs(reader* r, bt_surrogate* s) {
    if (!take_line(r, "inputs", 1) || !take_count(r, r->word[1], BT_INPUT_MAX, &s->dims))
        return false;
    if (s->dims < 1)
        return wrong(r, "a surrogate has at least one input; the file is damaged");
    for (int k = 0; k < s->dims; ++k) {
        if (!take_words(r, "input", 5, 6))
            return false;
        if (strlen(r->word[1]) >= BT_PATH_MAX)
            return wrong(r, "the name of an input is too long; the file is damaged");
        if (strcmp(r->word[1], "-") != 0)
            memcpy(s->path[k], r->word[1], strlen(r->word[1]) + 1);
        if (!take_real(r, r->word[2], &s->centre[k]) || !take_real(r, r->word[3], &s->scale[k]) ||
            !take_real(r, r->word[4], &s->least[k]) || !take_real(r, r->word[5], &s->greatest[k]))
            return false;
        s->weight[k] = 1;
        if (r->count > 6 && !take_real(r, r->word[6], &s->weight[k]))
            return false;
        if (!(s->scale[k] > 0))
            return wrong(r, "the scale of an input is not positive; the file is damaged");
    }
    return true;
}

static bool take_machine(reader* r, bt_surrogate* s) {
    if (!take_line(r, "machine", 4))
        return false;
    s->constant = !strcmp(r->word[1], "constant");
    if (!s->constant && strcmp(r->word[1], "svm") != 0)
        return wrong(r, "svm or constant should stand here; the file is damaged");
    return take_real(r, r->word[2], &s->C) && take_real(r, r->word[3], &s->gamma) &&
           take_real(r, r->word[4], &s->rho);
}

static bool take_scores(reader* r, bt_surrogate_scores* s) {
    int* const counts[] = {&s->train_count,     &s->train_correct,   &s->holdout_count,
                           &s->holdout_correct, &s->confusion[0][0], &s->confusion[0][1],
                           &s->confusion[1][0], &s->confusion[1][1], &s->cv_count,
                           &s->cv_correct};
    const int n = (int)(sizeof counts / sizeof *counts);
    if (!take_line(r, "scores", n))
        return false;
    for (int i = 0; i < n; ++i)
        if (!take_count(r, r->word[1 + i], INT32_MAX, counts[i]))
            return false;
    s->holdout_ci95 = bt_clopper_pearson(s->holdout_correct, s->holdout_count, 0.95);
    return take_line(r, "seconds", 1) && take_real(r, r->word[1], &s->seconds);
}

static bool take_vectors(reader* r, bt_surrogate* s, bt_status* status) {
    int count;
    if (!take_line(r, "vectors", 1) || !take_count(r, r->word[1], INT32_MAX / 64, &count))
        return false;
    // A vector takes more than a byte: a count beyond the file's size cannot be true.
    if (count > r->end - r->at)
        return wrong(r, "more support vectors than the file holds; the file is damaged");
    s->sv = malloc(((size_t)count * (size_t)s->dims + 1) * sizeof *s->sv);
    s->coef = malloc(((size_t)count + 1) * sizeof *s->coef);
    if (!s->sv || !s->coef) {
        *status = BT_ERR_MEMORY;
        return false;
    }
    for (int i = 0; i < count; ++i) {
        if (!take_line(r, "v", 1 + s->dims) || !take_real(r, r->word[1], &s->coef[i]))
            return false;
        for (int k = 0; k < s->dims; ++k)
            if (!take_real(r, r->word[2 + k], &s->sv[i * s->dims + k]))
                return false;
    }
    s->sv_count = count;
    uint64_t end;
    return take_hash(r, "end", &end);
}

bt_status bt_surrogate_load(const char* file, bt_surrogate* out, bt_diag* diag) {
    *out = (bt_surrogate){0};
    char* text;
    size_t size;
    BT_TRY(bt_file_read(file, &text, &size, diag));
    reader r = {.file = file, .at = text, .end = text + size, .diag = diag};
    bt_status status = BT_ERR_INPUT;
    if (take_identity(&r) && take_hash(&r, "study", &out->study_hash) &&
        take_hash(&r, "training", &out->training_hash) && take_inputs(&r, out) &&
        take_machine(&r, out) && take_scores(&r, &out->scores) && take_vectors(&r, out, &status))
        status = BT_OK;
    if (status != BT_OK)
        bt_surrogate_destroy(out);
    free(text);
    return status;
}

#include "report/figure_text.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = BT_FIGURE_TEXT_WIDTH, HEIGHT = BT_FIGURE_TEXT_HEIGHT };
static const char marks[] = "*+ox#@%=&$";

/// The field and what it spans.
typedef struct field {
    double least[2], greatest[2];
    char cell[HEIGHT][WIDTH + 1];
} field;

static void widen(field* f, int axis, double value) {
    if (!isfinite(value))
        return;
    f->least[axis] = fmin(f->least[axis], value);
    f->greatest[axis] = fmax(f->greatest[axis], value);
}

static bool span(field* f, const bt_figure* figure) {
    for (int axis = 0; axis < 2; ++axis) {
        f->least[axis] = INFINITY;
        f->greatest[axis] = -INFINITY;
    }
    for (int i = 0; i < figure->series_count; ++i) {
        const bt_series* s = &figure->series[i];
        for (int k = 0; k < s->count && !s->second; ++k) {
            if (figure->x_max > 0 && s->x[k] > figure->x_max)
                continue;
            widen(f, 0, s->x[k]);
            widen(f, 1, s->y[k]);
            if (s->low) {
                widen(f, 1, s->low[k]);
                widen(f, 1, s->high[k]);
            }
        }
    }
    if (figure->from_zero && isfinite(f->least[1]))
        f->least[1] = 0;
    for (int axis = 0; axis < 2; ++axis)
        if (f->greatest[axis] <= f->least[axis])
            f->greatest[axis] = f->least[axis] + 1;
    return isfinite(f->least[0]) && isfinite(f->least[1]);
}

static int place(const field* f, int axis, double value, int cells) {
    const double share = (value - f->least[axis]) / (f->greatest[axis] - f->least[axis]);
    return (int)floor(share * (cells - 1) + 0.5);
}

static void mark(field* f, double x, double y, char c) {
    if (!isfinite(x) || !isfinite(y))
        return;
    const int column = place(f, 0, x, WIDTH), line = HEIGHT - 1 - place(f, 1, y, HEIGHT);
    if (column >= 0 && column < WIDTH && line >= 0 && line < HEIGHT)
        f->cell[line][column] = c;
}

static void draw_bars(field* f, const bt_series* s) {
    for (int k = 0; s->low && k < s->count; ++k)
        for (int i = 0; i <= HEIGHT; ++i)
            mark(f, s->x[k], s->low[k] + (s->high[k] - s->low[k]) * i / HEIGHT, '|');
}

/// A line between two points, a mark per column.
static void draw_line(field* f, const bt_series* s, int k, char c) {
    const int from = place(f, 0, s->x[k - 1], WIDTH), to = place(f, 0, s->x[k], WIDTH);
    const int steps = abs(to - from);
    for (int i = 1; i < steps && steps <= WIDTH; ++i) {
        const double share = (double)i / steps;
        mark(f, s->x[k - 1] + share * (s->x[k] - s->x[k - 1]),
             s->y[k - 1] + share * (s->y[k] - s->y[k - 1]), c);
    }
}

static void draw(field* f, const bt_series* s, char c) {
    draw_bars(f, s);
    const bool lines = s->style == BT_SERIES_LINE;
    for (int k = 0; k < s->count; ++k) {
        if (k > 0 && lines && isfinite(s->y[k]) && isfinite(s->y[k - 1]))
            draw_line(f, s, k, c);
        mark(f, s->x[k], s->y[k], c);
    }
}

/// A text of the study's without what a terminal could take for a command.
static void put_text(FILE* out, const char* text) {
    for (; text && *text; ++text)
        fputc(iscntrl((unsigned char)*text) ? ' ' : *text, out);
}

static void print_field(const field* f, const bt_figure* figure, FILE* out) {
    put_text(out, figure->title);
    fprintf(out, "%s", figure->title ? "\n" : "");
    for (int line = 0; line < HEIGHT; ++line) {
        char label[16] = "";
        if (line == 0)
            snprintf(label, sizeof label, "%.4g", f->greatest[1]);
        if (line == HEIGHT - 1)
            snprintf(label, sizeof label, "%.4g", f->least[1]);
        int used = WIDTH;
        while (used > 0 && f->cell[line][used - 1] == ' ')
            --used;
        fprintf(out, "%9s |%.*s\n", label, used, f->cell[line]);
    }
    fprintf(out, "          +");
    for (int i = 0; i < WIDTH; ++i)
        fputc('-', out);
    char least[16], greatest[16];
    snprintf(least, sizeof least, "%.4g", f->least[0]);
    snprintf(greatest, sizeof greatest, "%.4g", f->greatest[0]);
    fprintf(out, "\n           %-*s%s\n", WIDTH - (int)strlen(greatest), least, greatest);
}

static void print_key(const bt_figure* figure, FILE* out) {
    fprintf(out, "           x: ");
    put_text(out, figure->x_label);
    fprintf(out, "; y: ");
    put_text(out, figure->y_label);
    fputc('\n', out);
    for (int i = 0; i < figure->series_count; ++i) {
        if (!figure->series[i].label || figure->series[i].second)
            continue;
        fprintf(out, "           %c ", marks[(size_t)i % (sizeof marks - 1)]);
        put_text(out, figure->series[i].label);
        fputc('\n', out);
    }
}

void bt_figure_print(const bt_figure* figure, FILE* out) {
    field f;
    if (!span(&f, figure))
        return;
    for (int line = 0; line < HEIGHT; ++line) {
        memset(f.cell[line], ' ', WIDTH);
        f.cell[line][WIDTH] = '\0';
    }
    for (int i = 0; i < figure->series_count; ++i)
        if (!figure->series[i].second)
            draw(&f, &figure->series[i], marks[(size_t)i % (sizeof marks - 1)]);
    print_field(&f, figure, out);
    print_key(figure, out);
}

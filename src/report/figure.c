#define _GNU_SOURCE /* posix_spawn_file_actions_addchdir_np, pipe2 */
#include "report/figure.h"

#include "base/directory.h"
#include "base/text.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

// Okabe and Ito's colours, told apart by every kind of colour vision.
static const char* const distinct[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                       "#e69f00", "#56b4e9", "#000000"};
enum { DISTINCT_COUNT = sizeof distinct / sizeof distinct[0] };

// --- data -------------------------------------------------------------------------------------

static void put_number(FILE* out, double value) {
    char text[40];
    if (!isfinite(value))
        return; // an empty cell: gnuplot leaves a gap
    bt_text_print_rounded(value, 9, text, sizeof text);
    fputs(text, out);
}

static void put_series_data(FILE* out, const bt_series* series) {
    fprintf(out, "# %s\n# x,y%s\n", series->label ? series->label : "",
            series->low ? ",low,high" : "");
    for (int i = 0; i < series->count; ++i) {
        put_number(out, series->x[i]);
        fputc(',', out);
        put_number(out, series->y[i]);
        if (series->low) {
            fputc(',', out);
            put_number(out, series->low[i]);
            fputc(',', out);
            put_number(out, series->high[i]);
        }
        fputc('\n', out);
    }
    fputs("\n\n", out); // separates gnuplot's blocks
}

static void put_data(FILE* out, const bt_figure* figure) {
    fputs("# ", out);
    for (const char* c = figure->title ? figure->title : figure->name; *c; ++c)
        fputc((unsigned char)*c < ' ' ? ' ' : *c, out);
    fprintf(out, "\n# x: %s\n# y: %s\n", figure->x_label, figure->y_label);
    for (int i = 0; i < figure->series_count; ++i)
        put_series_data(out, &figure->series[i]);
}

// --- script -----------------------------------------------------------------------------------

/// A text in gnuplot's single quotes: a quote is doubled.
static void put_quoted(FILE* out, const char* text) {
    fputc('\'', out);
    for (; text && *text; ++text) {
        if (*text == '\'')
            fputc('\'', out);
        fputc((unsigned char)*text < ' ' ? ' ' : *text, out);
    }
    fputc('\'', out);
}

static void put_setting(FILE* out, const char* name, const char* text) {
    if (!text)
        return;
    fprintf(out, "set %s ", name);
    put_quoted(out, text);
    fputc('\n', out);
}

/// From dark violet over green to orange: steps that are told apart in grey as well.
static void ramp_colour(int step, int count, char colour[8]) {
    static const double stop[5][3] = {
        {68, 1, 84}, {59, 82, 139}, {33, 145, 140}, {94, 190, 80}, {240, 170, 20}};
    const double at = count > 1 ? 4.0 * step / (count - 1) : 0;
    const int i = at < 4 ? (int)at : 3;
    int part[3];
    for (int k = 0; k < 3; ++k)
        part[k] = (int)lround(stop[i][k] + (at - i) * (stop[i + 1][k] - stop[i][k]));
    snprintf(colour, 8, "#%02x%02x%02x", (unsigned)part[0] & 255, (unsigned)part[1] & 255,
             (unsigned)part[2] & 255);
}

static void choose_colour(const bt_figure* figure, int index, char colour[8]) {
    int before = 0, count = 0; // references have no part in the order
    for (int i = 0; i < figure->series_count; ++i) {
        const bool counts = figure->series[i].style != BT_SERIES_REFERENCE;
        before += counts && i < index;
        count += counts;
    }
    if (figure->series[index].style == BT_SERIES_REFERENCE)
        snprintf(colour, 8, "#808080");
    else if (figure->ordered)
        ramp_colour(before, count, colour);
    else
        snprintf(colour, 8, "%s", distinct[before % DISTINCT_COUNT]);
}

static void put_style(FILE* out, const bt_figure* figure, int index) {
    char colour[8];
    const bt_series_style style = figure->series[index].style;
    choose_colour(figure, index, colour);
    static const char* const with[] = {"lines", "points", "linespoints", "lines"};
    fprintf(out, "with %s lc rgb '%s'", with[style], colour);
    if (style != BT_SERIES_POINTS)
        fputs(style == BT_SERIES_REFERENCE ? " lw 1.5 dt 2" : " lw 2", out);
    if (style == BT_SERIES_POINTS || style == BT_SERIES_LINE_POINTS)
        fputs(" pt 7 ps 0.9", out);
}

static void put_plot(FILE* out, const bt_figure* figure) {
    fputs("plot ", out);
    for (int i = 0; i < figure->series_count; ++i) {
        const bt_series* series = &figure->series[i];
        if (series->low) {
            char colour[8];
            choose_colour(figure, i, colour);
            fprintf(out, "%sdata index %d using 1:2:3:4 with yerrorbars lc rgb '%s' pt 0 notitle",
                    i ? ", \\\n     " : "", i, colour);
        }
        fprintf(out, "%sdata index %d using 1:2 ", i || series->low ? ", \\\n     " : "", i);
        put_style(out, figure, i);
        fputs(series->second ? " axes x1y2" : "", out);
        fputs(series->label ? " title " : " notitle", out);
        if (series->label)
            put_quoted(out, series->label);
    }
    fputc('\n', out);
}

static void put_axes(FILE* out, const bt_figure* figure) {
    char text[40];
    if (figure->x_free)
        fputs("set offsets graph 0.03, graph 0.03, 0, 0\n", out);
    fprintf(out, "set xrange [%s:", figure->x_free ? "*" : "0");
    bt_text_print_rounded(figure->x_max, 9, text, sizeof text);
    fprintf(out, "%s]\n", figure->x_max > 0 ? text : "*");
    bt_text_print_rounded(figure->y_max, 9, text, sizeof text);
    fprintf(out, "set yrange [%s:%s]\n", figure->from_zero ? "0" : "*",
            figure->y_max > 0 ? text : "*");
}

/// For print: across two columns of a page, and in one, without the title that its caption repeats.
static void put_print(FILE* out, const bt_figure* figure) {
    fprintf(out,
            "set terminal pdfcairo size 17.5cm,9cm font 'sans-serif,9' noenhanced\n"
            "set output '%s.pdf'\nreplot\nset output\n"
            "unset title\n"
            "set key outside bottom center horizontal height 0.7 samplen 1.5 spacing 1.1\n"
            "set terminal pdfcairo size 8.5cm,7cm font 'sans-serif,7' noenhanced\n"
            "set output '%s-column.pdf'\nreplot\nset output\n",
            figure->name, figure->name);
}

static void put_script(FILE* out, const bt_figure* figure) {
    fprintf(out, "# Draws %s as .png, .svg, .pdf and -column.pdf: gnuplot %s.gp\n", figure->name,
            figure->name);
    fprintf(out, "data = '%s.csv'\n", figure->name);
    fputs("set datafile separator ','\n"
          "set encoding utf8\n"
          "set border 3 lc rgb '#404040'\n"
          "set tics nomirror out\n"
          "set grid lc rgb '#d8d8d8' lt 1 lw 0.6\n"
          "set key outside",
          out);
    fputs(figure->key_below ? " bottom center horizontal height 0.7" : " right top vertical", out);
    fputs(" Left reverse noenhanced samplen 2 spacing 1.3\n", out);
    put_setting(out, "key title", figure->key_title);
    put_setting(out, "title", figure->title);
    put_setting(out, "xlabel", figure->x_label);
    put_setting(out, "ylabel", figure->y_label);
    put_setting(out, "y2label", figure->y2_label);
    if (figure->y2_label)
        fputs("set border 11\nset ytics nomirror\nset y2tics\n", out);
    put_axes(out, figure);
    fprintf(out,
            "set terminal pngcairo size 1200,750 font 'DejaVu Sans,13' noenhanced\n"
            "set output '%s.png'\n",
            figure->name);
    put_plot(out, figure);
    fprintf(out,
            "set terminal svg size 900,560 font 'sans-serif,13' noenhanced background 'white'\n"
            "set output '%s.svg'\nreplot\nset output\n",
            figure->name);
    put_print(out, figure);
}

/// Writes one of the two texts under its name.
static bt_status write_text(const bt_figure* figure, const char* folder, const char* ending,
                            void (*put)(FILE*, const bt_figure*), bt_diag* diag) {
    char name[256], path[BT_FILE_PATH_MAX], *text = NULL;
    size_t size = 0;
    snprintf(name, sizeof name, "%s%s", figure->name, ending);
    BT_TRY(bt_file_path(path, folder, name));
    FILE* out = open_memstream(&text, &size);
    if (!out)
        return BT_ERR_MEMORY;
    put(out, figure);
    const bool good = fclose(out) == 0;
    const bt_status status = good ? bt_file_write(path, text, size, diag) : BT_ERR_MEMORY;
    free(text);
    return status;
}

// --- gnuplot ----------------------------------------------------------------------------------

/// Reads what gnuplot said, at most size - 1 bytes, in one line.
static void read_words(int pipe_end, char* words, size_t size) {
    size_t used = 0;
    char rest[256];
    for (;;) {
        const bool room = used + 1 < size;
        const ssize_t got = room ? read(pipe_end, words + used, size - 1 - used)
                                 : read(pipe_end, rest, sizeof rest);
        if (got <= 0)
            break;
        used += room ? (size_t)got : 0;
    }
    words[used] = '\0';
    for (char* c = words; *c; ++c)
        if ((unsigned char)*c < ' ')
            *c = ' ';
}

/// Starts gnuplot in the folder with its messages going to pipe_end. Returns an errno.
static int start(const char* folder, const char* script, int pipe_end, pid_t* process) {
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0)
        return ENOMEM;
    char* const arguments[] = {(char[]){"gnuplot"}, (char*)script, NULL};
    int code = posix_spawn_file_actions_addchdir_np(&actions, folder);
    if (code == 0)
        code = posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    if (code == 0)
        code = posix_spawn_file_actions_adddup2(&actions, pipe_end, STDOUT_FILENO);
    if (code == 0)
        code = posix_spawn_file_actions_adddup2(&actions, pipe_end, STDERR_FILENO);
    if (code == 0)
        code = posix_spawnp(process, "gnuplot", &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return code;
}

static void draw(const bt_figure* figure, const char* folder, bt_diag* diag) {
    char script[256], words[512] = "";
    int ends[2], result = 0;
    pid_t process;
    snprintf(script, sizeof script, "%s.gp", figure->name);
    if (pipe2(ends, O_CLOEXEC) != 0) {
        bt_diag_add(diag, BT_WARNING, (bt_where){.file = folder}, "%s was not drawn: %s",
                    figure->name, strerror(errno));
        return;
    }
    const int code = start(folder, script, ends[1], &process);
    close(ends[1]);
    if (code == 0) {
        read_words(ends[0], words, sizeof words);
        while (waitpid(process, &result, 0) < 0 && errno == EINTR)
            ;
    }
    close(ends[0]);
    if (code == ENOENT)
        bt_diag_add(diag, BT_WARNING, (bt_where){.file = folder},
                    "%s was not drawn: there is no gnuplot here; its data and script are written, "
                    "draw it later with: cd %s && gnuplot %s",
                    figure->name, folder, script);
    else if (code != 0)
        bt_diag_add(diag, BT_WARNING, (bt_where){.file = folder}, "%s was not drawn: %s",
                    figure->name, strerror(code));
    else if (!WIFEXITED(result) || WEXITSTATUS(result) != 0)
        bt_diag_add(diag, BT_WARNING, (bt_where){.file = folder},
                    "%s was not drawn; gnuplot said: %s", figure->name, words);
}

/// Whether the script that stands there is one that Bolter wrote.
static bool script_is_ours(const char* path) {
    char first[16] = "";
    FILE* file = fopen(path, "r");
    const bool ours =
        file && fgets(first, sizeof first, file) && strncmp(first, "# Draws ", 8) == 0;
    if (file)
        fclose(file);
    return ours;
}

/// A figure takes the place of one that Bolter drew; other files of its names stay, and are said.
static bt_status spare_other_files(const bt_figure* figure, const char* folder, bt_diag* diag) {
    static const char* const endings[] = {".gp", ".csv", ".png", ".svg", ".pdf", "-column.pdf"};
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; ++i) {
        char name[256], path[BT_FILE_PATH_MAX];
        snprintf(name, sizeof name, "%s%s", figure->name, endings[i]);
        BT_TRY(bt_file_path(path, folder, name));
        if (i == 0 && script_is_ours(path))
            return BT_OK;
        if (access(path, F_OK) == 0)
            return bt_file_refuse(path, diag);
    }
    return BT_OK;
}

bt_status bt_figure_write(const bt_figure* figure, const char* folder, bt_diag* diag) {
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        bt_diag_add(diag, BT_ERROR, (bt_where){.file = folder}, "cannot make this folder: %s",
                    strerror(errno));
        return BT_ERR_IO;
    }
    BT_TRY(spare_other_files(figure, folder, diag));
    BT_TRY(write_text(figure, folder, ".csv", put_data, diag));
    BT_TRY(write_text(figure, folder, ".gp", put_script, diag));
    draw(figure, folder, diag);
    return BT_OK;
}

/* svg.h - step 5 of the command, if asked for: what its pictures share, a page with a title, labels and axes. */
#ifndef SURFMINK_COMMAND_SVG_H
#define SURFMINK_COMMAND_SVG_H

#include "../picture/svg.h"
#include "picture.h"
#include "summary.h"
#include <errno.h>

static const double half_turn = 3.141592653589793;

/* Pixels. A page of 700 to 1300 is printed 85 to 180 mm wide: texts of 20 are then 6 to 9 points high. */
enum { MARGIN = 20, TITLE_SPACE = 44, TEXT_SIZE = 20, TITLE_SIZE = 25 };

/* --- texts -------------------------------------------------------------------------------------------------------- */

/* How many characters, not bytes. */
static size_t text_length(const char *text)
{
    size_t length = 0;
    for (; *text; ++text) length += ((unsigned char)*text & 0xc0) != 0x80;
    return length;
}

/* About, in letters of TEXT_SIZE: fonts differ. */
static double text_width(const char *text)
{
    return 0.54 * TEXT_SIZE * (double)text_length(text);
}

static void put_label(FILE *file, double x, double y, enum anchor anchor, const char *text)
{
    begin_text(file, x, y, anchor, "");
    put_text(file, text, IN_XML);
    fputs("</text>\n", file);
}

/* Up to four digits. */
static void put_tick(FILE *file, double x, double y, enum anchor anchor, double value)
{
    char text[32];
    *write_number(NULL, text, 4, value) = '\0';
    put_label(file, x, y, anchor, text);
}

/* The letter mu with its rank; without one if that is 0: then p stands for it. */
static void put_mu(FILE *file, int p)
{
    fputs("<tspan font-style=\"italic\">\xce\xbc</tspan><tspan font-size=\"70%\" dy=\"5\"", file);
    if (p > 0)
        fprintf(file, ">%d</tspan>", p);
    else
        fputs(" font-style=\"italic\">p</tspan>", file);
}

/* Does a name begin with this word? */
static int is_of(const quantity *q, const char *word)
{
    size_t length = strlen(word);
    return strncmp(q->name, word, length) == 0 && q->name[length] == '_' && q->rank > 0;
}

/* The name of a column as a formula where it is one. Ends a little below the line if it has a rank. */
static void put_quantity(FILE *file, const quantity *q)
{
    static const char *const greek[3][2] = {{"mu", "\xce\xbc"}, {"theta", "\xce\xb8"}, {"sigma", "\xcf\x83"}};
    int i;
    for (i = 0; i < 3; ++i)
        if (is_of(q, greek[i][0])) {
            fprintf(file, "<tspan font-style=\"italic\">%s</tspan><tspan font-size=\"70%%\" dy=\"5\">%d</tspan>",
                    greek[i][1], q->rank);
            return;
        }
    fputs(strlen(q->name) == 1 ? "<tspan font-style=\"italic\">" : "<tspan>", file);
    put_text(file, q->name, IN_XML);
    fputs("</tspan><tspan dy=\"5\"></tspan>", file);
}

/* How many letters the name of a column has as a formula. */
static size_t quantity_letters(const quantity *q)
{
    return is_of(q, "mu") || is_of(q, "theta") || is_of(q, "sigma") ? 3 : strlen(q->name);
}

/* Letters of `most` pixels, or of as many as there is room for. */
static double quantity_size(const quantity *q, double most, double room)
{
    return fmin(most, room / (0.54 * (double)quantity_letters(q)));
}

/* a, b, c, ... at the upper left of a panel. */
static void put_letter(FILE *file, double x, double y, int number)
{
    char letter[2] = {'a', '\0'};
    letter[0] = (char)('a' + number);
    begin_text(file, x, y, AT_START, "font-weight=\"bold\"");
    fprintf(file, "%s</text>\n", letter);
}

/* --- axes --------------------------------------------------------------------------------------------------------- */

/* What is a round number of at most `most`: 1, 2 or 5 times a power of ten. */
static double round_step(double most)
{
    double step = pow(10, floor(log10(most)));
    if (step > most) step /= 10; /* log10 may round up */
    return 5 * step <= most ? 5 * step : 2 * step <= most ? 2 * step : step;
}

/* What a column is drawn against: from one multiple of a step to another. */
typedef struct range {
    double low, high, step;
    int turn; /* p of theta_p, which goes from -pi/p to pi/p; 0: another column */
} range;

static range range_of_theta(int p)
{
    range r;
    r.high = r.step = half_turn / p;
    r.low = -r.high;
    r.turn = p;
    return r;
}

/* Round numbers round the values, 0 among them if they are all of one sign and it is not far. */
static range range_of_values(double least, double most)
{
    range r = {0, 1, 0.2, 0};
    if (!(least <= most)) return r; /* there are no values */
    if (least > 0 && (least < most / 4 || !(least < most))) least = 0;
    if (most < 0 && (most > least / 4 || !(least < most))) most = 0;
    if (!(least < most)) most = least + 1;
    r.step = round_step((most - least) / 3);
    r.low = r.step * floor(least / r.step);
    r.high = r.step * ceil(most / r.step);
    return r;
}

static int range_ticks(const range *r)
{
    return (int)((r->high - r->low) / r->step + 0.5);
}

/* An axis, or the ticks along a bar of colours, and what they stand for: `from` and a step more each. */
typedef struct axis {
    double x, y, length; /* where it begins; upwards it is negative */
    char direction;      /* 'h', 'v' */
    double tick;         /* their length */
    double label[2];     /* from a tick to its text */
    enum anchor anchor;  /* of the text */
    int ticks, every;    /* how many steps, and which of them are shown */
    double step;
    double from;
    int turn; /* as of a range */
} axis;

/* -pi/p, 0, pi/p. */
static void put_turn(FILE *file, double x, double y, enum anchor anchor, double value, int p)
{
    char text[32];
    snprintf(text, sizeof text, p > 1 ? "%s\xcf\x80/%d" : "%s\xcf\x80", value < 0 ? "\xe2\x88\x92" : "", p);
    put_label(file, x, y, anchor, fabs(value) * p < 1 ? "0" : text);
}

static void put_axis(FILE *file, const axis *a, int with_line)
{
    int i, right = a->direction == 'h';
    fputs("<path fill=\"none\" stroke=\"#222\" d=\"", file);
    if (with_line) put_line(file, a->x, a->y, a->direction, a->length);
    for (i = 0; i <= a->ticks; i += a->every) {
        double at = a->length * i / a->ticks;
        put_line(file, a->x + (right ? at : 0), a->y + (right ? 0 : at), right ? 'v' : 'h', a->tick);
    }
    fputs("\"/>\n", file);
    for (i = 0; i <= a->ticks; i += a->every) {
        double at = a->length * i / a->ticks;
        double x = a->x + (right ? at : 0) + a->label[0], y = a->y + (right ? 0 : at) + a->label[1];
        double value = a->from + i * a->step;
        if (a->turn > 0)
            put_turn(file, x, y, a->anchor, value, a->turn);
        else
            put_tick(file, x, y, a->anchor, fabs(value) < 1e-9 * a->step ? 0 : value);
    }
}

/* --- the page ----------------------------------------------------------------------------------------------------- */

static FILE *open_page(const char *name)
{
    FILE *file = fopen(name, "wb");
    if (!file) die("%s: %s", name, strerror(errno));
    return file;
}

static void close_page(FILE *file, const char *name)
{
    int failed = ferror(file);
    if (fclose(file) != 0 || failed) die("%s: cannot write: %s", name, strerror(errno));
}

/* Text up to a line end would be taken for markup; the description goes on where this ends. */
static void begin_page(FILE *file, int width, int height, const options *o, const char *title)
{
    begin_svg(file, width, height,
              "role=\"img\" aria-labelledby=\"title description\" font-family=\"Helvetica, Arial, sans-serif\" "
              "font-size=\"20\""); /* TEXT_SIZE */
    fputs("<title id=\"title\">", file);
    put_text(file, o->title ? o->title : title, IN_XML);
    fputs("</title>\n<desc id=\"description\">", file);
}

/* Behind the description: a white page, and the title in letters that it has room for. */
static void end_description(FILE *file, int width, const options *o)
{
    double size;
    fputs("</desc>\n", file);
    put_paper(file);
    if (!o->title) return;
    size = fmin(TITLE_SIZE, (width - 2 * MARGIN) / (0.56 * (double)(text_length(o->title) + 1)));
    fputs("<g font-size=\"", file);
    put_pixels(file, size);
    fputs("\" font-weight=\"bold\" fill=\"#222\">", file);
    put_label(file, MARGIN, MARGIN + 24, AT_START, o->title);
    fputs("</g>\n", file);
}

static int title_space(const options *o)
{
    return o->title ? TITLE_SPACE : 0;
}

#endif

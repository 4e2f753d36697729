/* svg.h - step 5 of the command, if asked for: what all pictures share, a page of Scalable Vector Graphics.

   Every number is printed with two decimals of a pixel, so the same input gives the same bytes. */
#ifndef SURFMINK_COMMAND_SVG_H
#define SURFMINK_COMMAND_SVG_H

#include "picture.h"
#include "summary.h"
#include <errno.h>

/* Pixels. A page of 700 to 1300 is printed 85 to 180 mm wide: texts of 20 are then 6 to 9 points high. */
enum { MARGIN = 20, TITLE_SPACE = 44, TEXT_SIZE = 20, TITLE_SIZE = 25 };

/* --- colour ------------------------------------------------------------------------------------------------------- */

/* From indigo over teal to yellow: a path of constant speed through the colour space OKLab, lightness 0.30 to 0.92, hue
   285 to 102 degrees. Lightness alone orders the colours: it works for any colour vision, and printed in grey. */
static const int color_map[11][3] = {{43, 33, 97},    {23, 58, 123},   {0, 80, 128},   {1, 102, 131},
                                     {2, 126, 138},   {1, 150, 142},   {0, 171, 138},  {77, 189, 129},
                                     {142, 204, 122}, {196, 218, 126}, {243, 232, 144}};

static void find_color(double fraction, int part[3])
{
    double place = 10 * fmin(1, fmax(0, fraction)), rest;
    int i = place < 10 ? (int)place : 9, k;
    rest = place - i;
    for (k = 0; k < 3; ++k) part[k] = (int)(color_map[i][k] + rest * (color_map[i + 1][k] - color_map[i][k]) + 0.5);
}

static void put_color(FILE *file, double fraction)
{
    int part[3];
    find_color(fraction, part);
    fprintf(file, "#%02x%02x%02x", (unsigned)part[0], (unsigned)part[1], (unsigned)part[2]);
}

/* --- numbers ------------------------------------------------------------------------------------------------------ */

/* Two decimals, without what can be left out, and never -0. */
static void put_pixels(FILE *file, double pixels)
{
    long hundredths = lround(100 * fmin(1e6, fmax(-1e6, pixels))); /* farther out nothing can be seen */
    long whole = labs(hundredths) / 100, part = labs(hundredths) % 100;
    if (hundredths < 0) fputc('-', file);
    fprintf(file, "%ld", whole);
    if (part % 10)
        fprintf(file, ".%02ld", part);
    else if (part)
        fprintf(file, ".%ld", part / 10);
}

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

enum anchor { AT_START, AT_MIDDLE, AT_END };

static void begin_text(FILE *file, double x, double y, enum anchor anchor, const char *attributes)
{
    static const char *const word[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    fputs("<text x=\"", file);
    put_pixels(file, x);
    fputs("\" y=\"", file);
    put_pixels(file, y);
    fprintf(file, "\"%s%s%s>", word[anchor], *attributes ? " " : "", attributes);
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

/* a, b, c, ... at the upper left of a panel. */
static void put_letter(FILE *file, double x, double y, int number)
{
    char letter[2] = {'a', '\0'};
    letter[0] = (char)('a' + number);
    begin_text(file, x, y, AT_START, "font-weight=\"bold\"");
    fprintf(file, "%s</text>\n", letter);
}

/* --- lines along the axes ----------------------------------------------------------------------------------------- */

/* What is a round number of at most `most`: 1, 2 or 5 times a power of ten. */
static double round_step(double most)
{
    double step = pow(10, floor(log10(most)));
    if (step > most) step /= 10; /* log10 may round up */
    return 5 * step <= most ? 5 * step : 2 * step <= most ? 2 * step : step;
}

static void put_line(FILE *file, double x, double y, char direction, double length)
{
    fputc('M', file);
    put_pixels(file, x);
    fputc(' ', file);
    put_pixels(file, y);
    fputc(direction, file);
    put_pixels(file, length);
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
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" role=\"img\" "
            "aria-labelledby=\"title description\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"%d\">\n"
            "<title id=\"title\">",
            width, height, width, height, TEXT_SIZE);
    put_text(file, o->title ? o->title : title, IN_XML);
    fputs("</title>\n<desc id=\"description\">", file);
}

/* Behind the description: a white page, and the title in letters that it has room for. */
static void end_description(FILE *file, int width, const options *o)
{
    double size;
    fputs("</desc>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", file);
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

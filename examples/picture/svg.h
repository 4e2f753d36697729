/* svg.h - Scalable Vector Graphics: what all pictures of examples/ share. Colours, numbers, and the beginnings of
   elements, which the caller ends.

   Every number is printed with at most two decimals of a pixel, whatever the locale, so the same input gives the same
   bytes. y goes downwards. */
#ifndef SURFMINK_PICTURE_SVG_H
#define SURFMINK_PICTURE_SVG_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* --- colour ------------------------------------------------------------------------------------------------------- */

/* From indigo over teal to yellow: a path of constant speed through the colour space OKLab, lightness 0.30 to 0.92, hue
   285 to 102 degrees. Lightness alone orders the colours: it works for any colour vision, and printed in grey. */
static const int color_map[11][3] = {{43, 33, 97},    {23, 58, 123},   {0, 80, 128},   {1, 102, 131},
                                     {2, 126, 138},   {1, 150, 142},   {0, 171, 138},  {77, 189, 129},
                                     {142, 204, 122}, {196, 218, 126}, {243, 232, 144}};

/* For angles, whose ends are the same: from dark over blue to pale in the middle, over red to the same dark. Straight in
   OKLab between lightness 0.27, 0.58 and 0.95; lightness alone tells how far an angle is from 0. */
static const int turn_map[11][3] = {{51, 29, 52},    {63, 66, 106},   {66, 104, 166},  {100, 147, 207},
                                    {168, 193, 224}, {238, 238, 238}, {227, 176, 170}, {207, 113, 104},
                                    {164, 70, 69},   {105, 50, 62},   {51, 29, 52}};

static inline void find_color_in(const int map[11][3], double fraction, int part[3])
{
    double place = 10 * fmin(1, fmax(0, fraction)), rest;
    int i = place < 10 ? (int)place : 9, k;
    rest = place - i;
    for (k = 0; k < 3; ++k) part[k] = (int)(map[i][k] + rest * (map[i + 1][k] - map[i][k]) + 0.5);
}

static inline void find_color(double fraction, int part[3])
{
    find_color_in(color_map, fraction, part);
}

static inline void put_color(FILE *file, const int part[3])
{
    fprintf(file, "#%02x%02x%02x", (unsigned)part[0], (unsigned)part[1], (unsigned)part[2]);
}

/* The share of the light that a part of a colour sends, as the Web Content Accessibility Guidelines define it. */
static inline double luminance(const int part[3])
{
    static const double weight[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0, share;
    int k;
    for (k = 0; k < 3; ++k) {
        share = part[k] / 255.0;
        sum += weight[k] * (share <= 0.04045 ? share / 12.92 : pow((share + 0.055) / 1.055, 2.4));
    }
    return sum;
}

/* What shows best on a colour: white, or the darkest colour of the map. Their contrast, (lighter + 0.05) / (darker +
   0.05), is at least 3.75 on any colour; the guidelines ask for 3. */
static inline const char *ink_on(const int part[3])
{
    double light = luminance(part) + 0.05, dark = luminance(color_map[0]) + 0.05;
    return light * light > 1.05 * dark ? "#2b2161" : "#fff";
}

/* --- numbers ------------------------------------------------------------------------------------------------------ */

/* Two decimals, without what can be left out, and never -0. */
static inline void put_pixels(FILE *file, double pixels)
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

/* --- the page ----------------------------------------------------------------------------------------------------- */

static inline void begin_svg(FILE *file, double width, double height, const char *attributes)
{
    fprintf(file, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%g\" height=\"%g\" viewBox=\"0 0 %g %g\" %s>\n",
            width, height, width, height, attributes);
}

/* All of it is white. */
static inline void put_paper(FILE *file)
{
    fputs("<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n", file);
}

/* --- shapes ------------------------------------------------------------------------------------------------------- */

static inline void put_attribute(FILE *file, const char *name, double pixels)
{
    fprintf(file, " %s=\"", name);
    put_pixels(file, pixels);
    fputc('"', file);
}

static inline void begin_circle(FILE *file, double x, double y, double radius)
{
    fputs("<circle", file);
    put_attribute(file, "cx", x);
    put_attribute(file, "cy", y);
    put_attribute(file, "r", radius);
}

static inline void begin_rect(FILE *file, double x, double y, double width, double height)
{
    fputs("<rect", file);
    put_attribute(file, "x", x);
    put_attribute(file, "y", y);
    put_attribute(file, "width", width);
    put_attribute(file, "height", height);
}

/* Part of a path: from a point to the right or left ('h'), or down or up ('v'). */
static inline void put_line(FILE *file, double x, double y, char direction, double length)
{
    fputc('M', file);
    put_pixels(file, x);
    fputc(' ', file);
    put_pixels(file, y);
    fputc(direction, file);
    put_pixels(file, length);
}

/* --- texts -------------------------------------------------------------------------------------------------------- */

enum anchor { AT_START, AT_MIDDLE, AT_END };

static inline void begin_text(FILE *file, double x, double y, enum anchor anchor, const char *attributes)
{
    static const char *const word[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    fputs("<text x=\"", file);
    put_pixels(file, x);
    fputs("\" y=\"", file);
    put_pixels(file, y);
    fprintf(file, "\"%s%s%s>", word[anchor], *attributes ? " " : "", attributes);
}

#endif

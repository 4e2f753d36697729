/* plot.h - figures as SVG: axes, bars, legends, and curves on surfaces seen from far away - MIT or public domain

     plot p;
     plot_axes axes = {60, 20, 300, 200, {1e-3, 1}, {1e-6, 1}, {1, 1}};  // left, top, width, height; x, y; logarithmic
     if (plot_begin(&p, "errors.svg", 400, 280)) return 1;
     plot_frame(&p, &axes, 0, 0, "grid size $h$", "error of $\\mu_p$");
     plot_curve(&p, &axes, h, error, n, plot_pens[1], plot_markers[1]);
     return plot_end(&p);

   Units are SVG's: about 1/96 inch, y downwards. Nothing is kept: every call writes its element and forgets it, so what
   is drawn later lies on top. The first failure to write is remembered and comes back from plot_end.

   Colours of lines are those of Okabe and Ito, which colour-blind readers can tell apart; lines also differ by marker
   and dash. The ramp is that of the command.
   Text has a little markup: $h$ is italic, _x or _{xy} below, ^x or ^{xy} above, and \mu \nu \pi ... are Greek.      */
#ifndef PLOT_H
#define PLOT_H

#include "camera.h"
#include "svg.h"

#include <string.h>

#define PLOT_PI 3.14159265358979323846

typedef struct plot {
    FILE *file;
    int names; /* how many gradients and clips have been named */
} plot;

/* How a line is drawn; dash "" is solid. */
typedef struct plot_pen {
    const char *colour;
    double width;
    const char *dash;
} plot_pen;

enum plot_marker { PLOT_NONE, PLOT_DISC, PLOT_SQUARE, PLOT_TRIANGLE, PLOT_DIAMOND, PLOT_RING, PLOT_BOX, PLOT_CROSS };

/* Line k of a plot: each differs from the others by colour, by dash and by marker. */
static const plot_pen plot_pens[8] = {{"#000000", 1.4, ""},    {"#0072b2", 1.4, ""},        {"#d55e00", 1.4, "7 2"},
                                      {"#009e73", 1.4, "2 2"}, {"#cc79a7", 1.4, "6 2 2 2"}, {"#e69f00", 1.4, "4 2"},
                                      {"#56b4e9", 1.4, "1 2"}, {"#666666", 1.4, "9 3"}};
static const enum plot_marker plot_markers[8] = {PLOT_DISC, PLOT_SQUARE, PLOT_TRIANGLE, PLOT_DIAMOND,
                                                 PLOT_RING, PLOT_BOX,    PLOT_CROSS,    PLOT_DISC};
static const plot_pen plot_thin = {"#000000", 0.8, ""};
static const plot_pen plot_faint = {"#dddddd", 0.6, ""};
static const plot_pen plot_no_line = {"none", 0, ""};

/* Opens a figure on white paper. Returns 0, or 1 if the file cannot be written. */
static inline int plot_begin(plot *p, const char *path, double width, double height)
{
    p->names = 0;
    p->file = fopen(path, "w");
    if (!p->file) {
        perror(path);
        return 1;
    }
    begin_svg(
        p->file, width, height,
        "xmlns:xlink=\"http://www.w3.org/1999/xlink\" font-family=\"Helvetica, Arial, 'DejaVu Sans', sans-serif\" "
        "stroke-linejoin=\"round\" stroke-linecap=\"round\"");
    put_paper(p->file);
    return 0;
}

/* Returns 0, or 1 if something could not be written. */
static inline int plot_end(plot *p)
{
    int failed;
    fputs("</svg>\n", p->file);
    failed = ferror(p->file);
    return fclose(p->file) != 0 || failed;
}

/* --- colours ------------------------------------------------------------------------------------------------------ */

/* The colour of t = 0 .. 1, into text of 8 characters. */
static inline const char *plot_ramp(double t, char text[8])
{
    int rgb[3];
    find_color(t, rgb);
    snprintf(text, 8, "#%02x%02x%02x", (unsigned)rgb[0] & 255u, (unsigned)rgb[1] & 255u, (unsigned)rgb[2] & 255u);
    return text;
}

/* --- text --------------------------------------------------------------------------------------------------------- */

/* The UTF-8 of a name after a backslash, and its length in the markup. */
static inline const char *plot__symbol(const char *at, size_t *used)
{
    static const char *const table[][2] = {
        {"alpha", "\xce\xb1"},  {"gamma", "\xce\xb3"}, {"theta", "\xce\xb8"},     {"kappa", "\xce\xba"},
        {"mu", "\xce\xbc"},     {"nu", "\xce\xbd"},    {"pi", "\xcf\x80"},        {"phi", "\xcf\x86"},
        {"tau", "\xcf\x84"},    {"omega", "\xcf\x89"}, {"minus", "\xe2\x88\x92"}, {"to", "\xe2\x86\x92"},
        {"le", "\xe2\x89\xa4"}, {"dot", "\xc2\xb7"},   {"deg", "\xc2\xb0"},       {"dash", "\xe2\x80\x93"}};
    size_t k;
    for (k = 0; k < sizeof table / sizeof *table; ++k) {
        *used = strlen(table[k][0]);
        if (strncmp(at, table[k][0], *used) == 0) return table[k][1];
    }
    *used = 0;
    return "\\";
}

/* The inside of a <text> element. Each piece is a tspan that undoes the shift of the one before. */
static inline void plot__markup(plot *p, const char *text, double size)
{
    double shift = 0, last = 0;
    int italic = 0, braces = 0, level = 0; /* level: -1 below, 1 above the line */
    while (*text) {
        size_t used = 1;
        char one[3] = {0, 0, 0};
        const char *glyph = one;
        int letter;
        if (*text == '$') {
            italic = !italic;
            ++text;
            continue;
        }
        if ((*text == '_' || *text == '^') && level == 0) {
            level = *text++ == '_' ? -1 : 1;
            braces = *text == '{';
            if (braces) ++text;
            continue;
        }
        if (*text == '}' && braces) {
            level = braces = 0;
            ++text;
            continue;
        }
        letter = (*text >= 'a' && *text <= 'z') || (*text >= 'A' && *text <= 'Z') || *text == '\\';
        if (*text == '\\')
            glyph = plot__symbol(text + 1, &used), ++used;
        else if (*text == '&')
            glyph = "&amp;";
        else if (*text == '<')
            glyph = "&lt;";
        else if (*text == '>')
            glyph = "&gt;";
        else
            one[0] = *text;
        shift = level < 0 ? 0.22 * size : level > 0 ? -0.36 * size : 0;
        fprintf(p->file, "<tspan");
        if (shift < last || shift > last) fprintf(p->file, " dy=\"%.2f\"", shift - last);
        if (level) fprintf(p->file, " font-size=\"%.1f\"", 0.72 * size);
        if (italic && letter) fprintf(p->file, " font-style=\"italic\"");
        fprintf(p->file, ">%s", glyph);
        text += used;
        while (*text && !strchr("$_^{}\\&<>", *text) && (!level || braces) &&
               letter == ((*text >= 'a' && *text <= 'z') || (*text >= 'A' && *text <= 'Z')))
            fputc(*text++, p->file);
        fprintf(p->file, "</tspan>");
        last = shift;
        if (level && !braces) level = 0;
    }
}

/* Text at (x, y); turned to run upwards if asked. */
static inline void plot_text_as(plot *p, double x, double y, double size, enum anchor anchor, const char *colour,
                                int bold, int upwards, const char *text)
{
    char attributes[160], turned[64] = "";
    if (upwards) snprintf(turned, sizeof turned, " transform=\"rotate(-90 %.1f %.1f)\"", x, y);
    snprintf(attributes, sizeof attributes, "font-size=\"%g\" fill=\"%s\"%s%s xml:space=\"preserve\"", size, colour,
             bold ? " font-weight=\"bold\"" : "", turned);
    begin_text(p->file, x, y, anchor, attributes);
    plot__markup(p, text, size);
    fprintf(p->file, "</text>\n");
}

static inline void plot_text(plot *p, double x, double y, double size, enum anchor anchor, const char *text)
{
    plot_text_as(p, x, y, size, anchor, "#000000", 0, 0, text);
}

/* (a), (b), ... of a figure. */
static inline void plot_letter(plot *p, double x, double y, const char *text)
{
    plot_text_as(p, x, y, 13, AT_START, "#000000", 1, 0, text);
}

/* --- lines and areas ---------------------------------------------------------------------------------------------- */

static inline void plot__pen(plot *p, plot_pen pen)
{
    fprintf(p->file, " stroke=\"%s\" stroke-width=\"%g\"", pen.colour, pen.width);
    if (*pen.dash) fprintf(p->file, " stroke-dasharray=\"%s\"", pen.dash);
}

static inline void plot_line(plot *p, double x1, double y1, double x2, double y2, plot_pen pen)
{
    fputs("<line", p->file);
    put_attribute(p->file, "x1", x1);
    put_attribute(p->file, "y1", y1);
    put_attribute(p->file, "x2", x2);
    put_attribute(p->file, "y2", y2);
    plot__pen(p, pen);
    fprintf(p->file, "/>\n");
}

/* A point of a long path: a tenth of a pixel is fine enough. */
static inline void plot__point(plot *p, double x, double y)
{
    put_pixels(p->file, floor(10 * x + 0.5) / 10);
    fputc(' ', p->file);
    put_pixels(p->file, floor(10 * y + 0.5) / 10);
}

/* A chain of n points x y, closed and filled if fill is a colour. */
static inline void plot_path(plot *p, const double *xy, size_t n, int closed, plot_pen pen, const char *fill)
{
    size_t i;
    if (n == 0) return;
    fprintf(p->file, "<path d=\"M");
    for (i = 0; i < n; ++i) {
        if (i > 0) fputc(' ', p->file);
        plot__point(p, xy[2 * i], xy[2 * i + 1]);
    }
    fprintf(p->file, "%s\" fill=\"%s\"", closed ? "Z" : "", fill);
    plot__pen(p, pen);
    fprintf(p->file, "/>\n");
}

static inline void plot_box(plot *p, double x, double y, double width, double height, plot_pen pen, const char *fill)
{
    begin_rect(p->file, x, y, width, height);
    fprintf(p->file, " fill=\"%s\"", fill);
    plot__pen(p, pen);
    fprintf(p->file, "/>\n");
}

static inline void plot_disc(plot *p, double x, double y, double radius, plot_pen pen, const char *fill)
{
    begin_circle(p->file, x, y, radius);
    fprintf(p->file, " fill=\"%s\"", fill);
    plot__pen(p, pen);
    fprintf(p->file, "/>\n");
}

/* An arrow whose head shrinks with it, so that short ones do not turn into heads. */
static inline void plot_arrow(plot *p, double x1, double y1, double x2, double y2, plot_pen pen)
{
    double dx = x2 - x1, dy = y2 - y1, length = sqrt(dx * dx + dy * dy), head = 3.2 * pen.width + 1.5, tip[6];
    if (!(length > 0)) return;
    if (head > 0.5 * length) head = 0.5 * length;
    dx /= length;
    dy /= length;
    tip[0] = x2;
    tip[1] = y2;
    tip[2] = x2 - head * dx + 0.42 * head * dy;
    tip[3] = y2 - head * dy - 0.42 * head * dx;
    tip[4] = x2 - head * dx - 0.42 * head * dy;
    tip[5] = y2 - head * dy + 0.42 * head * dx;
    plot_line(p, x1, y1, x2 - 0.8 * head * dx, y2 - 0.8 * head * dy, pen);
    pen.width = 0.3;
    plot_path(p, tip, 3, 1, pen, pen.colour);
}

static inline void plot_mark(plot *p, enum plot_marker marker, double x, double y, double size, const char *colour)
{
    double r = size, xy[8];
    plot_pen pen = {"", 1.1, ""};
    const char *fill = marker == PLOT_RING || marker == PLOT_BOX ? "#ffffff" : colour;
    pen.colour = colour;
    switch (marker) {
    case PLOT_NONE: break;
    case PLOT_DISC:
    case PLOT_RING: plot_disc(p, x, y, r, pen, fill); break;
    case PLOT_SQUARE:
    case PLOT_BOX: plot_box(p, x - 0.85 * r, y - 0.85 * r, 1.7 * r, 1.7 * r, pen, fill); break;
    case PLOT_TRIANGLE:
    case PLOT_DIAMOND:
        xy[0] = x;
        xy[1] = y - 1.2 * r;
        xy[2] = x + 1.1 * r;
        xy[3] = marker == PLOT_TRIANGLE ? y + 0.8 * r : y;
        xy[4] = marker == PLOT_TRIANGLE ? x - 1.1 * r : x;
        xy[5] = marker == PLOT_TRIANGLE ? y + 0.8 * r : y + 1.2 * r;
        xy[6] = x - 1.1 * r;
        xy[7] = y;
        plot_path(p, xy, marker == PLOT_TRIANGLE ? 3 : 4, 1, pen, fill);
        break;
    case PLOT_CROSS:
        plot_line(p, x - r, y - r, x + r, y + r, pen);
        plot_line(p, x - r, y + r, x + r, y - r, pen);
        break;
    }
}

/* What is drawn between these two is kept under a name, and appears wherever it is repeated. */
static inline void plot_keep(plot *p, const char *name)
{
    fprintf(p->file, "<defs><g id=\"%s\">\n", name);
}

static inline void plot_kept(plot *p)
{
    fprintf(p->file, "</g></defs>\n");
}

static inline void plot_repeat(plot *p, const char *name, double x, double y)
{
    fprintf(p->file, "<use xlink:href=\"#%s\" x=\"%g\" y=\"%g\"/>\n", name, x, y);
}

/* --- axes --------------------------------------------------------------------------------------------------------- */

/* low > high turns an axis round. */
typedef struct plot_axes {
    double left, top, width, height;
    double x[2], y[2]; /* at the left and right, at the bottom and top */
    int logarithmic[2];
} plot_axes;

static inline double plot__share(const double range[2], int logarithmic, double value)
{
    if (logarithmic) return log(value / range[0]) / log(range[1] / range[0]);
    return (value - range[0]) / (range[1] - range[0]);
}

static inline double plot_x(const plot_axes *axes, double x)
{
    return axes->left + axes->width * plot__share(axes->x, axes->logarithmic[0], x);
}

static inline double plot_y(const plot_axes *axes, double y)
{
    return axes->top + axes->height * (1 - plot__share(axes->y, axes->logarithmic[1], y));
}

/* A tick of the x axis (dim 0) or y axis (dim 1) with its grid line. */
static inline void plot__tick(plot *p, const plot_axes *axes, int dim, double value, const char *label)
{
    double bottom = axes->top + axes->height, right = axes->left + axes->width, at;
    if (dim == 0) {
        at = plot_x(axes, value);
        plot_line(p, at, axes->top, at, bottom, plot_faint);
        plot_line(p, at, bottom, at, bottom - 4, plot_thin);
        plot_text(p, at, bottom + 13, 10, AT_MIDDLE, label);
    } else {
        at = plot_y(axes, value);
        plot_line(p, axes->left, at, right, at, plot_faint);
        plot_line(p, axes->left, at, axes->left + 4, at, plot_thin);
        plot_text(p, axes->left - 5, at + 3.5, 10, AT_END, label);
    }
}

/* Ticks at all multiples of step, labelled with the number and the given unit; a logarithmic axis has powers of ten. */
static inline void plot_ticks(plot *p, const plot_axes *axes, int dim, double step, const char *unit)
{
    const double *range = dim == 0 ? axes->x : axes->y;
    double low = fmin(range[0], range[1]), high = fmax(range[0], range[1]), value;
    int logarithmic = axes->logarithmic[dim], k;
    int first = (int)ceil((logarithmic ? log10(low) : low / step) - 1e-9);
    int last = (int)floor((logarithmic ? log10(high) : high / step) + 1e-9);
    char label[64];
    for (k = first; k <= last; ++k) {
        value = logarithmic ? pow(10, k) : k * step;
        if (logarithmic && (k == 0 || k == 1))
            snprintf(label, sizeof label, k ? "10" : "1");
        else if (logarithmic)
            snprintf(label, sizeof label, "10^{%s%d}", k < 0 ? "\\minus" : "", k < 0 ? -k : k);
        else if (k == 0)
            snprintf(label, sizeof label, "0");
        else
            snprintf(label, sizeof label, "%s%g%s", k < 0 ? "\\minus" : "", fabs(value), unit);
        plot__tick(p, axes, dim, value, label);
    }
}

/* The box with ticks and titles. A step of 0 means no ticks, unless the axis is logarithmic. */
static inline void plot_frame(plot *p, const plot_axes *axes, double step_x, double step_y, const char *title_x,
                              const char *title_y)
{
    if (step_x > 0 || axes->logarithmic[0]) plot_ticks(p, axes, 0, step_x, "");
    if (step_y > 0 || axes->logarithmic[1]) plot_ticks(p, axes, 1, step_y, "");
    plot_box(p, axes->left, axes->top, axes->width, axes->height, plot_thin, "none");
    plot_text(p, axes->left + axes->width / 2, axes->top + axes->height + 30, 11, AT_MIDDLE, title_x);
    plot_text_as(p, axes->left - 36, axes->top + axes->height / 2, 11, AT_MIDDLE, "#000000", 0, 1, title_y);
}

/* n points of a function; what leaves the box is cut off. */
static inline void plot_curve(plot *p, const plot_axes *axes, const double *x, const double *y, size_t n, plot_pen pen,
                              enum plot_marker marker)
{
    size_t i;
    fprintf(p->file, "<clipPath id=\"c%d\">", ++p->names);
    begin_rect(p->file, axes->left - 4, axes->top - 4, axes->width + 8, axes->height + 8);
    fputs("/></clipPath>\n", p->file);
    fprintf(p->file, "<g clip-path=\"url(#c%d)\">\n<path d=\"M", p->names);
    for (i = 0; i < n; ++i) {
        if (i > 0) fputc(' ', p->file);
        plot__point(p, plot_x(axes, x[i]), plot_y(axes, y[i]));
    }
    fprintf(p->file, "\" fill=\"none\"");
    plot__pen(p, pen);
    fprintf(p->file, "/>\n");
    for (i = 0; i < n && marker != PLOT_NONE; ++i)
        plot_mark(p, marker, plot_x(axes, x[i]), plot_y(axes, y[i]), 3, pen.colour);
    fprintf(p->file, "</g>\n");
}

/* One line of a legend: a sample at (x, y), then what it means. */
static inline void plot_key(plot *p, double x, double y, plot_pen pen, enum plot_marker marker, const char *text)
{
    if (pen.width > 0) plot_line(p, x, y, x + 24, y, pen);
    plot_mark(p, marker, x + 12, y, 3, pen.colour);
    plot_text(p, x + 29, y + 3.5, 10, AT_START, text);
}

/* Bars of values 0 .. 1 for p = first .. last, each with its p below it, so that colour only repeats what it says. */
static inline void plot_bars(plot *p, const plot_axes *axes, const double *value, int first, int last, double text)
{
    double step = axes->width / (last - first + 1), width = 0.72 * step, x, y, bottom = axes->top + axes->height;
    plot_pen edge = {"#000000", 0.5, ""};
    char colour[8], label[16];
    int k;
    for (k = first; k <= last; ++k) {
        x = axes->left + (k - first + 0.5) * step;
        y = plot_y(axes, value[k]);
        plot_box(p, x - width / 2, y, width, bottom - y, edge,
                 plot_ramp(0.1 + 0.85 * (k - first) / (last > first ? last - first : 1), colour));
        snprintf(label, sizeof label, "%d", k);
        plot_text(p, x, bottom + text + 1, text, AT_MIDDLE, label);
    }
    plot_line(p, axes->left, bottom, axes->left + axes->width, bottom, plot_thin);
}

/* A scale of plot_ramp, from 0 at the bottom to 1 at the top. */
static inline void plot_scale(plot *p, double x, double y, double width, double height, const char *title)
{
    char colour[8];
    int k, steps = 40;
    for (k = 0; k < steps; ++k)
        plot_box(p, x, y + height * (steps - 1 - k) / steps, width, height / steps + 0.4, plot_no_line,
                 plot_ramp((k + 0.5) / steps, colour));
    plot_box(p, x, y, width, height, plot_thin, "none");
    plot_text(p, x + width + 4, y + height + 3.5, 10, AT_START, "0");
    plot_text(p, x + width + 4, y + 3.5, 10, AT_START, "1");
    plot_text(p, x + width / 2, y - 7, 11, AT_MIDDLE, title);
}

/* --- surfaces, seen from far away --------------------------------------------------------------------------------- */

typedef struct plot_view {
    camera camera;
    double x, y, scale; /* where the origin is drawn, and how long a unit is */
} plot_view;

/* A solid, as a function that is negative inside it. What it hides is found by walking from a point to the eye. */
typedef double plot_solid(const void *shape, const double x[3]);

/* The view from an azimuth round the z axis and an elevation above the xy plane, both in degrees. */
static inline plot_view plot_look(double azimuth, double elevation, double x, double y, double scale)
{
    plot_view view;
    look_from_lonlat(&view.camera, azimuth, elevation);
    view.x = x;
    view.y = y;
    view.scale = scale;
    return view;
}

static inline void plot_project(const plot_view *view, const double x[3], double xy[2])
{
    xy[0] = view->x + view->scale * dot(x, view->camera.right);
    xy[1] = view->y - view->scale * dot(x, view->camera.up);
}

/* Does the solid hide a point of its surface? size: how far to walk, more than its diameter. */
static inline int plot_hidden(const plot_view *view, plot_solid *solid, const void *shape, double size,
                              const double x[3])
{
    double y[3], walked;
    int step, k, steps = 160;
    for (step = 1; step <= steps; ++step) {
        walked = size * (step + 0.0) * step / steps / steps; /* small steps first: most is hidden by what is near */
        for (k = 0; k < 3; ++k) y[k] = x[k] + walked * view->camera.eye[k];
        if (solid(shape, y) < -1e-6) return 1;
    }
    return 0;
}

/* A curve of n points on the surface of a solid, drawn with one pen where it is seen and another where it is not. */
static inline void plot_curve_on(plot *p, const plot_view *view, plot_solid *solid, const void *shape, double size,
                                 const double *x, size_t n, int closed, plot_pen seen, plot_pen hidden)
{
    double run[2 * 512];
    size_t i, count = 0, last = closed ? n : n - 1;
    int before = -1, now;
    for (i = 0; i <= last; ++i) {
        const double *point = x + 3 * (i % n);
        now = plot_hidden(view, solid, shape, size, point);
        plot_project(view, point, run + 2 * count++);
        if ((before >= 0 && now != before) || count == 512 || i == last) { /* the run ends here, and the next begins */
            plot_pen pen = before == 1 || (before < 0 && now) ? hidden : seen;
            if (pen.width > 0 && count > 1) plot_path(p, run, count, 0, pen, "none");
            run[0] = run[2 * count - 2];
            run[1] = run[2 * count - 1];
            count = 1;
        }
        before = now;
    }
}

/* The solid ellipsoid about the origin; shape is its three semi-axes. */
static inline double plot_in_ellipsoid(const void *shape, const double x[3])
{
    const double *axis = (const double *)shape;
    double sum = -1;
    int k;
    for (k = 0; k < 3; ++k) sum += x[k] * x[k] / (axis[k] * axis[k]);
    return sum;
}

/* A shaded ellipsoid. Its outline is an ellipse: the image of the unit sphere under the 2 x 3 matrix of the view times
   the axes, whose two singular directions are the ellipse's. */
static inline void plot_ellipsoid(plot *p, const plot_view *view, const double axis[3])
{
    double m[2][3], a, b, c, middle, spread, turn;
    int k;
    for (k = 0; k < 3; ++k) {
        m[0][k] = view->scale * view->camera.right[k] * axis[k];
        m[1][k] = -view->scale * view->camera.up[k] * axis[k];
    }
    a = dot(m[0], m[0]);
    b = dot(m[0], m[1]);
    c = dot(m[1], m[1]);
    middle = (a + c) / 2;
    spread = sqrt((a - c) * (a - c) / 4 + b * b);
    turn = atan2(2 * b, a - c) / 2;
    fprintf(p->file,
            "<radialGradient id=\"g%d\" cx=\"0.5\" cy=\"0.5\" r=\"0.5\" fx=\"0.4\" fy=\"0.35\"><stop offset=\"0\" "
            "stop-color=\"#ffffff\"/><stop offset=\"0.7\" stop-color=\"#ededed\"/><stop offset=\"1\" "
            "stop-color=\"#c4c4c4\"/></radialGradient>\n",
            ++p->names);
    fprintf(p->file,
            "<ellipse rx=\"%.2f\" ry=\"%.2f\" transform=\"translate(%.2f %.2f) rotate(%.2f)\" fill=\"url(#g%d)\" "
            "stroke=\"#888888\" stroke-width=\"0.7\"/>\n",
            sqrt(middle + spread), sqrt(fmax(middle - spread, 0)), view->x, view->y, turn * 180 / PLOT_PI, p->names);
}

/* Faint lines on an ellipsoid, every so many degrees of the chart (theta, phi). */
static inline void plot_graticule(plot *p, const plot_view *view, const double axis[3], int degrees)
{
    plot_pen pen = {"#b5b5b5", 0.4, ""};
    double x[3 * 121], theta, phi;
    int line, k;
    for (line = 0; line < 360 + 180; line += degrees) {
        if (line == 360) continue; /* theta = 0 is a point */
        for (k = 0; k <= 120; ++k) {
            theta = line < 360 ? PLOT_PI * k / 120 : (line - 360) * PLOT_PI / 180;
            phi = line < 360 ? line * PLOT_PI / 180 : 2 * PLOT_PI * k / 120;
            x[3 * k] = axis[0] * sin(theta) * cos(phi);
            x[3 * k + 1] = axis[1] * sin(theta) * sin(phi);
            x[3 * k + 2] = axis[2] * cos(theta);
        }
        plot_curve_on(p, view, plot_in_ellipsoid, axis, 2.2 * fmax(axis[0], fmax(axis[1], axis[2])), x, 121, 0, pen,
                      plot_no_line);
    }
}

/* The solid torus round the z axis; shape is R, r. */
static inline double plot_in_torus(const void *shape, const double x[3])
{
    const double *radius = (const double *)shape;
    double across = sqrt(x[0] * x[0] + x[1] * x[1]) - radius[0];
    return across * across + x[2] * x[2] - radius[1] * radius[1];
}

/* A shaded torus of small patches. What is hidden is left out; patches half hidden come first, the far ones before the
   near ones; the rest cannot overlap, so all of one shade share an element, which keeps files small. Each has a
   hairline of its own colour, or gaps would show between them. */
static inline void plot_torus(plot *p, const plot_view *view, const double radius[2])
{
    enum { AROUND = 45, TUBE = 24, SHADES = 16 };
    static struct {
        double depth, corner[8];
        int shade;
    } patch[AROUND * TUBE], moved;
    int count = 0, whole, i, j, k, seen, last = -1;
    for (whole = 0; whole < 2; ++whole) {
        count = 0;
        for (i = 0; i < AROUND; ++i)
            for (j = 0; j < TUBE; ++j) {
                double light = 0, x[3], n[3];
                for (seen = 0, k = 0; k < 5; ++k) { /* four corners, then the middle */
                    double phi = 2 * PLOT_PI * (i + (k == 1 || k == 2) + (k == 4) * 0.5) / AROUND;
                    double theta = 2 * PLOT_PI * (j + (k == 2 || k == 3) + (k == 4) * 0.5) / TUBE;
                    n[0] = cos(theta) * cos(phi);
                    n[1] = cos(theta) * sin(phi);
                    n[2] = sin(theta);
                    x[0] = radius[0] * cos(phi) + radius[1] * n[0];
                    x[1] = radius[0] * sin(phi) + radius[1] * n[1];
                    x[2] = radius[1] * n[2];
                    if (k < 4) plot_project(view, x, patch[count].corner + 2 * k);
                    seen += !plot_hidden(view, plot_in_torus, radius, 2.2 * (radius[0] + radius[1]), x);
                }
                if (seen == 0 || (seen == 5) != whole) continue;
                light =
                    0.85 * dot(n, view->camera.eye) - 0.25 * dot(n, view->camera.right) + 0.3 * dot(n, view->camera.up);
                patch[count].shade = (int)((SHADES - 1) * fmin(fmax(light, 0), 1));
                patch[count].depth = whole ? patch[count].shade : dot(x, view->camera.eye);
                ++count;
            }
        for (i = 1; i < count; ++i) { /* insertion sort: a thousand patches */
            moved = patch[i];
            for (j = i; j > 0 && patch[j - 1].depth > moved.depth; --j) patch[j] = patch[j - 1];
            patch[j] = moved;
        }
        for (i = 0; i < count; ++i) {
            const double *c = patch[i].corner;
            unsigned grey = 190u + 4u * (unsigned)patch[i].shade;
            if (patch[i].shade != last) {
                if (last >= 0) fprintf(p->file, "\"/>\n");
                fprintf(p->file, "<path fill=\"#%02x%02x%02x\" stroke=\"#%02x%02x%02x\" stroke-width=\"0.5\" d=\"",
                        grey, grey, grey, grey, grey, grey);
                last = patch[i].shade;
            }
            fprintf(p->file, "M%.1f %.1fl%.1f %.1f %.1f %.1f %.1f %.1fz", c[0], c[1], c[2] - c[0], c[3] - c[1],
                    c[4] - c[2], c[5] - c[3], c[6] - c[4], c[7] - c[5]);
        }
    }
    if (last >= 0) fprintf(p->file, "\"/>\n");
}

/* The outline of a torus: where the normal is at right angles to the view. */
static inline void plot_torus_outline(plot *p, const plot_view *view, const double radius[2])
{
    plot_pen pen = {"#888888", 0.7, ""};
    double x[3 * 361], phi, theta;
    int branch, k;
    for (branch = 0; branch < 2; ++branch) {
        for (k = 0; k <= 360; ++k) {
            phi = k * PLOT_PI / 180;
            theta = atan2(-(view->camera.eye[0] * cos(phi) + view->camera.eye[1] * sin(phi)), view->camera.eye[2]) +
                    branch * PLOT_PI;
            x[3 * k] = (radius[0] + radius[1] * cos(theta)) * cos(phi);
            x[3 * k + 1] = (radius[0] + radius[1] * cos(theta)) * sin(phi);
            x[3 * k + 2] = radius[1] * sin(theta);
        }
        plot_curve_on(p, view, plot_in_torus, radius, 2.2 * (radius[0] + radius[1]), x, 361, 0, pen, plot_no_line);
    }
}

#endif /* PLOT_H */

/* plane.c - fuzzes what measures polygons of the plane: measure, edges, area, frame. */
#include "outline.h"

static void fuzz(bytes in)
{
    outline o;
    surfmink_outline view;
    measured m;
    double area = -7, frame[4] = {-7, -7, -7, -7}, nu_tau;
    size_t edge;
    int status;
    take_outline(&in, SURFMINK_PLANE, &o);
    view = view_of(&o);
    claim_invariants(&o);
    status = surfmink_area(&view, &area);
    CLAIM(is_known(status));
    CLAIM(status == SURFMINK_OK ? isfinite(area) : area == -7);
    if (surfmink_measure(&view, 0, NULL, NULL, &m.w, NULL) == SURFMINK_OK)
        CLAIM(status == SURFMINK_OK && fabs(area - m.w.area) <= 1e-15 * m.w.length * m.w.length + DBL_MIN &&
              m.w.curvature == 0);
    edge = take(&in);
    status = surfmink_frame(&view, edge, frame);
    CLAIM(is_known(status));
    nu_tau = frame[0] * frame[2] + frame[1] * frame[3];
    if (status == SURFMINK_OK)
        CLAIM(edge < o.n && nu_tau == 0 && fabs(hypot(frame[0], frame[1]) - 1) < 1e-15);
    else
        CLAIM(frame[0] == -7 && frame[3] == -7);
}

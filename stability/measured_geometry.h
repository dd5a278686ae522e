// Measured: frames, triangles as lights, where rays start.
#ifndef MEASURED_GEOMETRY_H
#define MEASURED_GEOMETRY_H

#include "measured_values.h"

SHARED_BEGIN

/// x 0-2 unit normal -> y 0-2 tangent, 3-5 bitangent.
FN void measure_frame(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    Frame f = frame_from_normal(measured_vec3(p, 0u));
    give_vec3(o, 0u, f.tangent);
    give_vec3(o, 3u, f.bitangent);
}

/// An emitter seen from 0, as emitters are kept: x 0-2 unit normal, 3-5 vertex, 6-8 and 9-11 edges, 12-13 u, 14 twice
/// its area -> y 0 solid angle, 1-2 barycentrics sampled, 3 their pdf, 4 the pdf that the same point has when a ray
/// finds it.
FN void measure_triangle(IN(MeasuredInput) p, INOUT(MeasuredOutput) o) {
    vec3 v0 = measured_vec3(p, 3u);
    vec3 e1 = measured_vec3(p, 6u);
    vec3 e2 = measured_vec3(p, 9u);
    TriangleView view = triangle_view(v0, e1, e2, measured_vec3(p, 0u), p.x[14]);
    o.y[0] = view_solid_angle(view);
    TriangleSample t = sample_triangle_view(view, v0, e1, e2, vec2(p.x[12], p.x[13]));
    o.y[1] = t.barycentrics.x;
    o.y[2] = t.barycentrics.y;
    o.y[3] = t.pdf;
    vec3 point = v0 + t.barycentrics.x * e1 + t.barycentrics.y * e2;
    o.y[4] = pdf_triangle_view(view, point);
}

SHARED_END

#define MEASURED_GEOMETRY(X)                                                                                           \
    X(frame)                                                                                                           \
    X(triangle)

#endif

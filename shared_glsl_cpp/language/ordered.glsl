// Sums of fixed order. GLSL does not define the order of the sum in a dot product, so the last bit of any normalised
// vector may differ between compilers. These functions use the order of C++, without contraction. On a chain of curved
// and bumpy surfaces that bit decides where a path goes (docs/decisions/0006).
vec3 xyz(vec4 v) { return v.xyz; }

float ordered_dot(vec2 a, vec2 b) {
    precise float sum = a.x * b.x + a.y * b.y;
    return sum;
}

float ordered_dot(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
    return sum;
}

vec3 ordered_cross(vec3 a, vec3 b) {
    precise vec3 product = vec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return product;
}

float ordered_length(vec2 v) { return sqrt(ordered_dot(v, v)); }
float ordered_length(vec3 v) { return sqrt(ordered_dot(v, v)); }

vec3 ordered_normalize(vec3 v) {
    precise vec3 unit = v * inversesqrt(ordered_dot(v, v));
    return unit;
}

#define dot ordered_dot
#define cross ordered_cross
#define length ordered_length
#define normalize ordered_normalize

#version 460
// Triangles of the interface, in pixels.
layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;

layout(push_constant) uniform Push {
    vec2 scale;      // from pixels to clip space
    vec2 translate;
} push;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec2 out_uv;

void main() {
    out_color = color;
    out_uv = uv;
    gl_Position = vec4(position * push.scale + push.translate, 0.0, 1.0);
}

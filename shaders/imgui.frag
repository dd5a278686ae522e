#version 460
// Colours and textures of the interface are display values, and are blended as such.
layout(location = 0) in vec4 color;
layout(location = 1) in vec2 uv;

layout(set = 0, binding = 0) uniform sampler2D image;

layout(location = 0) out vec4 out_color;

void main() { out_color = color * texture(image, uv); }

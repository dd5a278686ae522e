// Reads the chosen element of an array by the array's address, in scalar layout, whose vec3 have 12 bytes. Element 1 ends
// 24 bytes behind the address.
#version 460
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vectors { vec3 data[]; };
layout(set = 0, binding = 0, scalar) buffer Arguments { uvec2 address; };
layout(set = 0, binding = 1, scalar) buffer Results { vec3 results[]; };
layout(push_constant) uniform Push { uint count; uint chosen; };

void main() {
    if (gl_GlobalInvocationID.x < count) {
        results[gl_GlobalInvocationID.x] = Vectors(address).data[chosen];
    }
}

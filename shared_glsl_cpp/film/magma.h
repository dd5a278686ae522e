// The colour map of heat maps. X(red, green, blue) is every 17th of the 256 entries of 'magma', in display values.
// Linear interpolation between them is off by at most two codes of 8 bits.
#ifndef MAGMA_H
#define MAGMA_H

#define MAGMA_ENTRIES(X)               \
    X(0.001462f, 0.000466f, 0.013866f) \
    X(0.043830f, 0.033830f, 0.141886f) \
    X(0.123833f, 0.067295f, 0.295879f) \
    X(0.232077f, 0.059889f, 0.437695f) \
    X(0.341482f, 0.080564f, 0.492631f) \
    X(0.445163f, 0.122724f, 0.506901f) \
    X(0.550287f, 0.161158f, 0.505719f) \
    X(0.658483f, 0.196027f, 0.490253f) \
    X(0.767398f, 0.233705f, 0.457755f) \
    X(0.868793f, 0.287728f, 0.409303f) \
    X(0.944006f, 0.377643f, 0.365136f) \
    X(0.981000f, 0.498428f, 0.369734f) \
    X(0.994738f, 0.624350f, 0.427397f) \
    X(0.997228f, 0.747981f, 0.516859f) \
    X(0.993170f, 0.870024f, 0.626189f) \
    X(0.987053f, 0.991438f, 0.749504f)

#endif

#include <math.h>

void @function@(const float light[3], const float view[3], float rgb[3])
{
    // The network's layers: for each unit a row of weights.
    static const float w1[@w1@] = {
@rows1@
    };
    static const float b1[@h1@] = {
@biases1@
    };
    static const float w2[@w2@] = {
@rows2@
    };
    static const float b2[@h2@] = {
@biases2@
    };
    static const float w3[@w3@] = {
@rows3@
    };
    static const float b3[3] = {
@biases3@
    };

    if (!(light[2] > 0.0f && view[2] > 0.0f)) {
        rgb[0] = rgb[1] = rgb[2] = 0.0f;
        return;
    }
@coordinates@
    float sx = light[0] + view[0], sy = light[1] + view[1], sz = light[2] + view[2];
    const float ex = light[0] - view[0], ey = light[1] - view[1], ez = light[2] - view[2];
    if (sx * sx + sy * sy + sz * sz < 1e-6f) {
        sx = sy = 0.0f; // opposite, at the horizon: h is taken as the normal
        sz = 1.0f;
    }
    const float across = sqrtf(sx * sx + sy * sy);
    const float inverse = 1.0f / sqrtf(sx * sx + sy * sy + sz * sz);
    float dx = light[0], dy = light[1];
    const float dz = fabsf(sx * light[0] + sy * light[1] + sz * light[2]) * inverse;
    if (across > 1e-15f) { // else the azimuth of h is taken as 0
        dx = 0.5f * inverse * (sz * ((sx * ex + sy * ey) / across) - across * ez);
        dy = 0.5f * (sx * ey - sy * ex) / across;
    }
    const float x[@inputs@] = {@half@, dx, dy, dz};

    float first[@h1@];
    for (int j = 0; j < @h1@; ++j) {
        float sum = b1[j];
        for (int i = 0; i < @inputs@; ++i)
            sum += w1[@inputs@ * j + i] * x[i];
        first[j] = fmaxf(sum, 0.0f);
    }
    float second[@h2@];
    for (int j = 0; j < @h2@; ++j) {
        float sum = b2[j];
        for (int i = 0; i < @h1@; ++i)
            sum += w2[@h1@ * j + i] * first[i];
        second[j] = fmaxf(sum, 0.0f);
    }
    for (int j = 0; j < 3; ++j) {
        float y = b3[j];
        for (int i = 0; i < @h2@; ++i)
            y += w3[@h2@ * j + i] * second[i];
        rgb[j] = fmaxf(expm1f(fminf(y, 80.0f)), 0.0f);
    }
}

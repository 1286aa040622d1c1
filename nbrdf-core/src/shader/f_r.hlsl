float3 @function@(float3 light, float3 view)
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

    if (!(light.z > 0.0 && view.z > 0.0)) {
        return float3(0.0, 0.0, 0.0);
    }
@coordinates@
    float3 s = light + view;
    float3 e = light - view;
    if (dot(s, s) < 1e-6) {
        s = float3(0.0, 0.0, 1.0); // opposite, at the horizon: h is taken as the normal
    }
    float across = sqrt(dot(s.xy, s.xy));
    float inverse = 1.0 / sqrt(dot(s, s));
    float3 d = float3(light.xy, abs(dot(s, light)) * inverse);
    if (across > 1e-15) { // else the azimuth of h is taken as 0
        d.x = 0.5 * inverse * (s.z * (dot(s.xy, e.xy) / across) - across * e.z);
        d.y = 0.5 * (s.x * e.y - s.y * e.x) / across;
    }
    const float x[@inputs@] = {@half@, d.x, d.y, d.z};

    int i, j; // here: loops of old compilers do not keep them to themselves
    float first[@h1@];
    for (j = 0; j < @h1@; ++j) {
        float sum = b1[j];
        for (i = 0; i < @inputs@; ++i) {
            sum += w1[@inputs@ * j + i] * x[i];
        }
        first[j] = max(sum, 0.0);
    }
    float second[@h2@];
    for (j = 0; j < @h2@; ++j) {
        float sum = b2[j];
        for (i = 0; i < @h1@; ++i) {
            sum += w2[@h1@ * j + i] * first[i];
        }
        second[j] = max(sum, 0.0);
    }
    float rgb[3];
    for (j = 0; j < 3; ++j) {
        float y = b3[j];
        for (i = 0; i < @h2@; ++i) {
            y += w3[@h2@ * j + i] * second[i];
        }
        y = clamp(y, -80.0, 80.0);
        // exp(y) - 1, by its series where that difference would cancel.
        float series = y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0 * (1.0 + y / 5.0 * (1.0 + y / 6.0)))));
        rgb[j] = max(abs(y) < 0.25 ? series : exp(y) - 1.0, 0.0);
    }
    return float3(rgb[0], rgb[1], rgb[2]);
}

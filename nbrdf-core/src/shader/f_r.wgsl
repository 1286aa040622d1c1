fn @function@(light: vec3<f32>, view: vec3<f32>) -> vec3<f32> {
    // The network's layers: for each unit a row of weights.
    // Variables, since some compilers copy constants at every index.
    var w1 = array<f32, @w1@>(
@rows1@
    );
    var b1 = array<f32, @h1@>(
@biases1@
    );
    var w2 = array<f32, @w2@>(
@rows2@
    );
    var b2 = array<f32, @h2@>(
@biases2@
    );
    var w3 = array<f32, @w3@>(
@rows3@
    );
    var b3 = array<f32, 3>(
@biases3@
    );

    if (!(light.z > 0.0 && view.z > 0.0)) {
        return vec3<f32>(0.0);
    }
@coordinates@
    var s = light + view;
    let e = light - view;
    if (dot(s, s) < 1e-6) {
        s = vec3<f32>(0.0, 0.0, 1.0); // opposite, at the horizon: h is taken as the normal
    }
    let across = sqrt(dot(s.xy, s.xy));
    let inverse = 1.0 / sqrt(dot(s, s));
    var d = vec3<f32>(light.xy, abs(dot(s, light)) * inverse);
    if (across > 1e-15) { // else the azimuth of h is taken as 0
        d.x = 0.5 * inverse * (s.z * (dot(s.xy, e.xy) / across) - across * e.z);
        d.y = 0.5 * (s.x * e.y - s.y * e.x) / across;
    }
    var x = array<f32, @inputs@>(@half@, d.x, d.y, d.z);

    var first: array<f32, @h1@>;
    for (var j = 0; j < @h1@; j++) {
        var sum = b1[j];
        for (var i = 0; i < @inputs@; i++) {
            sum += w1[@inputs@ * j + i] * x[i];
        }
        first[j] = max(sum, 0.0);
    }
    var second: array<f32, @h2@>;
    for (var j = 0; j < @h2@; j++) {
        var sum = b2[j];
        for (var i = 0; i < @h1@; i++) {
            sum += w2[@h1@ * j + i] * first[i];
        }
        second[j] = max(sum, 0.0);
    }
    var rgb: array<f32, 3>;
    for (var j = 0; j < 3; j++) {
        var y = b3[j];
        for (var i = 0; i < @h2@; i++) {
            y += w3[@h2@ * j + i] * second[i];
        }
        y = clamp(y, -80.0, 80.0);
        // exp(y) - 1, by its series where that difference would cancel.
        let series = y * (1.0 + y / 2.0 * (1.0 + y / 3.0 * (1.0 + y / 4.0 * (1.0 + y / 5.0 * (1.0 + y / 6.0)))));
        rgb[j] = max(select(exp(y) - 1.0, series, abs(y) < 0.25), 0.0);
    }
    return vec3<f32>(rgb[0], rgb[1], rgb[2]);
}

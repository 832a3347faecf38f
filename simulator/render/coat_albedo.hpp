// How much light a coat mirrors in all directions together.
#pragma once

namespace traygauge {

// For light from, or to, a direction at this cosine to the normal. `coat`: share mirrored at normal
// incidence; `alpha`: GGX roughness from 0.01 to 1. From a table, within about 0.002.
float coat_albedo(float coat, float alpha, float cosine);

// Of light that arrives evenly from all directions.
float mean_coat_albedo(float coat, float alpha);

}  // namespace traygauge

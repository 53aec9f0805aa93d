// A thin film over a surface: light that its two sides reflect interferes. Belcour and Barla, "A Practical Extension to Microfacet Theory
// for the Modeling of Varying Iridescence" (TOG 2017). The approximations are those of KHR_materials_iridescence: Schlick's reflectance at
// both sides, a real index for metals, and two orders of interference.
#ifndef FILM_GLSL
#define FILM_GLSL
#include "bsdf/fresnel.glsl"
#include "math/trigonometry.glsl"

SHADER_BEGIN

struct Film {
  float share;  // the share of the surface that it covers; 0: there is none
  float thickness;  // in nanometres
  float ior;
  vec3 layer_f0;  // f0 and f90 without the film
  vec3 layer_f90;
  vec3 metal_f0;
  vec3 metal_f90;
};

Film no_film() {
  Film film;
  film.share = 0.0f;
  film.thickness = 0.0f;
  film.ior = 1.0f;
  film.layer_f0 = vec3(0.0f, 0.0f, 0.0f);
  film.layer_f90 = film.layer_f0;
  film.metal_f0 = film.layer_f0;
  film.metal_f90 = film.layer_f0;
  return film;
}

// One Gaussian of the colour matching functions' Fourier transform, at a path of so many nanometres.
float interference(float path, float weight, float position, float variance) {
  return weight * sine_cosine(position * path).y * exp_negative(-variance * (path * path));
}

// Linear sRGB of light that interferes with itself, so many nanometres behind. The coefficients are the paper's, in wavelengths per
// nanometre, with their weights made 1 for all light together.
vec3 interference_color(float path) {
  float x = interference(path, 0.84659f, 0.010562035f, 1.708547e-7f) + interference(path, 0.15386831f, 0.014073707f, 1.7876617e-7f);
  float y = interference(path, 1.0002219f, 0.011280203f, 3.6733088e-7f);
  float z = interference(path, 1.0011225f, 0.013875786f, 2.6103525e-7f);
  return vec3(3.2404542f * x - 1.5371385f * y - 0.4985314f * z, 1.8760108f * y - 0.969266f * x + 0.041556f * z,
              0.0556434f * x - 0.2040259f * y + 1.0572252f * z);
}

// The part of the film's reflectance that does not depend on the surface below, at one angle.
struct FilmLight {
  float outside;  // reflectance of its upper side
  float cosine;   // within it
  vec3 first;     // colours of the two orders of interference
  vec3 second;
};

FilmLight film_light(Film film, float cosine) {
  float r = (film.ior - 1.0f) / (film.ior + 1.0f);
  FilmLight light;
  light.outside = r * r + (1.0f - r * r) * fifth_power(1.0f - cosine);
  light.cosine = sqrt(maximum(1.0f - (1.0f - cosine * cosine) / (film.ior * film.ior), 0.0f));
  float path = 2.0f * film.ior * film.thickness * light.cosine;
  light.first = interference_color(path);
  light.second = interference_color(2.0f * path);
  return light;
}

// One channel. The light that the lower side reflects loses half a wave where the index below is the greater one, as light at the upper
// side does; else the orders' signs alternate.
float film_channel(Film film, FilmLight light, float f0, float first, float second) {
  float root = sqrt(minimum(maximum(f0, 0.0f), 0.9999f));
  float ior = (1.0f + root) / (1.0f - root);
  float r = (ior - film.ior) / (ior + film.ior);
  float inside = r * r + (1.0f - r * r) * fifth_power(1.0f - light.cosine);
  float both = minimum(maximum(light.outside * inside, 1.0e-5f), 0.9999f);
  float through = 1.0f - light.outside;
  float sum = through * through * inside / (1.0f - both);
  float order = (sum - through) * sqrt(both);
  float reflected = light.outside + sum + 2.0f * order * (ior < film.ior ? first : -first) + 2.0f * order * sqrt(both) * second;
  return minimum(maximum(reflected, 0.0f), 1.0f);
}

vec3 film_reflectance(Film film, FilmLight light, vec3 f0) {
  return vec3(film_channel(film, light, f0.x, light.first.x, light.second.x), film_channel(film, light, f0.y, light.first.y, light.second.y),
              film_channel(film, light, f0.z, light.first.z, light.second.z));
}

// The share of light that a surface of that f0 and f90 mirrors, partly under the film.
vec3 filmed_share(Film film, FilmLight light, vec3 f0, vec3 f90, float cosine) {
  vec3 bare = f0 + (f90 - f0) * fifth_power(1.0f - cosine);
  return bare * (1.0f - film.share) + film_reflectance(film, light, f0) * film.share;
}

// Schlick's curve through that share at that cosine. By it, albedos are looked up, as the tables have them for Schlick's curves alone. Where
// the film mirrors less than a curve from 0 to f90, the curve goes to less.
float film_f0(float share, float f90, float edge) { return share > f90 * edge ? (share - f90 * edge) / (1.0f - edge) : 0.0f; }
float film_f90(float share, float f90, float edge) { return share > f90 * edge ? f90 : share / edge; }

Fresnel schlick_through(vec3 share, vec3 f90, vec3 mean, float cosine) {
  float edge = minimum(fifth_power(1.0f - cosine), 0.99f);
  Fresnel fresnel = schlick(vec3(film_f0(share.x, f90.x, edge), film_f0(share.y, f90.y, edge), film_f0(share.z, f90.z, edge)),
                            vec3(film_f90(share.x, f90.x, edge), film_f90(share.y, f90.y, edge), film_f90(share.z, f90.z, edge)));
  fresnel.mean = mean;
  return fresnel;
}

// The mean over the half sphere by cosine: Gauss' four points in the square of the cosine.
vec3 filmed_mean_part(Film film, vec3 f0, vec3 f90, float cosine, float weight) {
  return filmed_share(film, film_light(film, cosine), f0, f90, cosine) * weight;
}
vec3 filmed_mean(Film film, vec3 f0, vec3 f90) {
  return filmed_mean_part(film, f0, f90, 0.26349923f, 0.17392742f) + filmed_mean_part(film, f0, f90, 0.57446451f, 0.32607258f) +
         filmed_mean_part(film, f0, f90, 0.81852949f, 0.32607258f) + filmed_mean_part(film, f0, f90, 0.96465964f, 0.17392742f);
}

// A surface of that f0 and f90 as the film makes it for light of that cosine. `mean`: filmed_mean.
Fresnel filmed(Film film, vec3 f0, vec3 f90, vec3 mean, float cosine) {
  return schlick_through(filmed_share(film, film_light(film, cosine), f0, f90, cosine), f90, mean, cosine);
}

SHADER_END
#endif

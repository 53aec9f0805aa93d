#include "host/reading/foreign_words.hpp"

#include <algorithm>
#include <cctype>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

namespace {

struct Word {
  std::string_view ours;
  std::string_view theirs;  // words of other renderers in lower case without - and _, between spaces
};

// A foreign word may stand in several rows. The first row whose own word is among the possible names counts.
constexpr Word words[] = {
    // Cameras
    {"eye", " location origin position pos from lookfrom viewpoint eyepoint "},
    {"target", " lookat at to interest pointofinterest focus lookto coi "},
    {"up", " sky vup upvector updirection "},
    {"fov", " angle fieldofview viewangle hfov xfov focallength focal lens "},
    {"fov_axis", " axis "},
    {"aperture", " lensradius apertureradius aperturesize "},
    {"focus", " focaldistance focusdistance focaldist focalpoint "},
    {"size", " orthoscale screenwindow "},
    // The picture, its samples and the integrator
    {"width", " resolution xresolution resolutionx resx xres size w "},
    {"height", " yresolution resolutiony resy yres h "},
    {"samples", " spp samplecount pixelsamples samplesperpixel aa antialias antialiasing "},
    {"pattern", " sampler jitter "},
    {"max_depth", " maxtracelevel recursionlimit depth bounces maxbounces maxraydepth "},
    {"min_throughput", " adcbailout threshold cutoff "},
    {"background", " backgroundcolor backgroundcolour sky skycolor world environment "},
    {"ambient", " ambientlight ambientcolor ka "},
    {"integrator", " method engine renderer tracer algorithm "},
    {"seed", " randomseed rngseed "},
    // Lights: for the same foreign words, a light's position comes before a shape's center
    {"intensity",
     " color colour power energy strength radiance irradiance emission brightness rgb spectrum i l "},
    {"falloff", " attenuation decay fadepower "},
    {"position", " location center centre origin from point pos "},
    {"direction", " to dir target lookat "},
    // Materials
    {"diffuse", " color colour pigment basecolor albedo kd texture map rgb "},
    {"specular", " ks specularcolor "},
    {"shininess", " exponent phongsize roughness glossiness specularpower ns "},
    {"reflectance", " reflection reflectivity reflective mirror metallic kr "},
    {"ior", " eta index indexofrefraction refractiveindex refraction interiorior intior n "},
    {"absorption", " sigmaa extinction fadecolor attenuation "},
    {"emission",
     " emissive emissivecolor emissivefactor emissioncolor emissionstrength emit emittance glow ke "},
    {"alpha", " opacity mask transparency "},
    {"highlight", " specularmodel "},
    {"name", " id label "},
    // Shapes
    {"center", " location origin position pos point translate at "},
    {"point", " position location origin center centre pos distance "},
    {"origin", " corner position point center centre p0 "},
    {"radius", " r rad size baseradius outerradius radius1 "},
    {"radii", " radius size semiaxes scale "},
    {"to_radius", " capradius topradius radius2 r2 "},
    {"inner_radius", " holeradius hole "},
    {"major_radius", " radius r majorr ringradius "},
    {"minor_radius", " tuberadius thickness minorr "},
    {"normal", " direction axis up n "},
    {"axis", " normal direction "},
    {"min", " corner1 lower low p0 pmin mincorner lowercorner from "},
    {"max", " corner2 upper high p1 pmax maxcorner uppercorner to size "},
    {"from", " base basepoint start bottom p0 center centre location "},
    {"tip", " apex vertex "},
    {"to", " cap cappoint end top apex p1 height length "},
    {"open", " uncapped capped "},
    {"vertices", " points positions corners p vertexlist vectors "},
    {"normals", " n vertexnormals normalvectors "},
    {"uv", " st uvs texcoords uvvectors "},
    {"edge_u", " edge1 u e1 "},
    {"edge_v", " edge2 v e2 "},
    {"corners", " vertices points positions p "},
    {"points", " vertices controlpoints corners p "},
    {"extrusion", " height depth length direction "},
    {"file", " filename path src source url obj ply "},
    {"smooth", " smoothangle autosmooth crease shadesmooth "},
    {"code", " function formula expression glsl f "},
    {"lipschitz", " maxgradient "},
    {"parameters", " params uniforms constants "},
    {"group", " object ref instance prototype of "},
    {"material", " texture pigment color colour bsdf brdf shader surface finish mat materialid "},
    {"even", " a color1 color0 "},
    {"odd", " b color2 color1 "},
    {"tint", " color colour multiply "},
    {"degrees", " angle "},
    {"rotate", " rotation turn euler "},
    {"scale", " size stretch "},
    {"translate", " translation move location position offset "},
    {"transform",
     " rotate rotation scale translate translation matrix toworld objecttoworld position location "},
    {"minus", " difference subtract without "},
    // Tables
    {"camera", " view viewpoint sensor perspective "},
    {"image", " film output picture resolution "},
    {"render", " globalsettings settings options integrator sampler background "},
    {"light", " lightsource lamp emitter pointlight directionallight distantlight sun spotlight arealight "},
    {"material", " texture bsdf brdf shader pigment finish surface "},
    {"medium", " fog haze mist atmosphere volume participatingmedium "},
    {"box", " cuboid cube block "},
    {"sphere", " ball orb "},
    {"disk", " disc circle "},
    {"parallelogram", " quad rectangle rect square "},
    {"polygon", " ngon "},
    {"points", " pointcloud cloud particles spheres "},
    {"mesh", " object obj model trimesh trianglemesh plymesh mesh2 gltf "},
    {"csg", " csg difference intersection union merge boolean "},
    {"implicit", " isosurface blob metaball metaballs sdf poly quartic cubic function gyroid "},
    {"bezier", " bicubicpatch patch "},
    {"superellipsoid", " superquadric "},
    {"capsule", " pill roundcone "},
    {"cone", " frustum "},
    {"group", " node assembly collection "},
    {"instance", " use clone "},
    // Values
    {"point", " omni bulb pointlight "},
    {"directional", " distant distantlight sun parallel "},
    {"phong", " blinn "},
    {"mirror", " specular reflective "},
    {"dielectric", " glass transparent refractive water roughdielectric frosted "},
    {"diffuse", " matte lambert lambertian orennayar "},
    {"conductor", " metal roughconductor "},
    {"plastic", " glossy roughplastic coateddiffuse "},
    {"principled", " standard disney pbr metallicroughness openpbr "},
    {"perspective", " pinhole persp "},
    {"orthographic", " ortho parallel "},
    {"whitted", " raytrace raytracing recursive "},
    {"raycast", " raycasting "},
    {"jittered", " stratified random "},
    {"regular", " grid uniform "},
    {"inverse_square", " quadratic physical "},
    {"bilinear", " linear trilinear "},
    {"nearest", " point closest "},
    {"linear", " raw noncolor "},
    {"intersection", " intersect and common "},
    {"union", " merge add or join "},
};

// Words for which no single value stands: they mean a key or a table, or a value that needs another key.
struct Advice {
  std::string_view choice;  // the advice is for keys that have this value
  std::string_view theirs;  // as in Word
  std::string_view text;
};

constexpr Advice advices[] = {
    {"diffuse", " emissive emission emitter light diffuselight arealight ",
     "write another type, such as \"diffuse\", with the key `emission`"},
    {"directional",
     " environment environmentmap envmap envlight hdri hdr ibl dome domelight sky skylight "
     "infinite constant ",
     "write the table [environment], with `image` or type = \"sky\""},
    {"area", " rect rectangle quad square rectlight arealight disk disc sphere triangle ",
     "write type = \"area\", with `shape`: \"rectangle\", \"disk\", \"sphere\" or \"triangle\""},
};

std::string plain(std::string_view word) {
  std::string text;
  for (const char c : word)
    if (c != '_' && c != '-') text += char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::string suggest_name(std::string_view word, std::span<const std::string_view> names) {
  constexpr size_t longest = 32;  // no foreign word of the table has more bytes
  if (word.size() > longest) return nearest_name(word, names);

  // Try in this order: a name that is only joined differently, another renderer's word, a typing error.
  const std::string plain_word = plain(word);
  for (const std::string_view name : names)
    if (plain(name) == plain_word) return std::string(name);
  const std::string whole = " " + plain_word + " ";
  for (const Word& each : words)
    if (each.theirs.find(whole) != std::string_view::npos &&
        std::ranges::find(names, each.ours) != names.end())
      return std::string(each.ours);
  return nearest_name(word, names);
}

std::string_view advice_on(std::string_view word, std::span<const std::string_view> choices) {
  const std::string whole = " " + plain(word.substr(0, 32)) + " ";
  for (const Advice& each : advices)
    if (each.theirs.find(whole) != std::string_view::npos &&
        std::ranges::find(choices, each.choice) != choices.end())
      return each.text;
  return "";
}

}  // namespace eyeray::engine::reading

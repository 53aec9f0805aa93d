// Include this before shader files that a .cpp compiles for itself alone: their definitions stay in that
// .cpp. It may be included again.
#undef SHADER_BEGIN
#undef SHADER_END
#define SHADER_BEGIN                 \
  namespace eyeray::engine::shader { \
  namespace {
#define SHADER_END \
  }                \
  }

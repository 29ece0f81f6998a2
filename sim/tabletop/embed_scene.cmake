# Writes OUT, a C++ source that holds the text of IN: cmake -DIN=scene.yaml -DOUT=scene.cpp -P embed_scene.cmake
file(READ "${IN}" text)
file(WRITE "${OUT}" "#include \"sim/tabletop/scene_file.h\"\n
namespace prospect::sim {\n
const char* DefaultStackingScene() {\n  return R\"yaml(${text})yaml\";\n}\n
}  // namespace prospect::sim\n")

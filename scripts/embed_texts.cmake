# Writes OUTPUT, a C++ file that holds the text of each of FILES (separated by |) under its path below ROOT.
# cmake -DOUTPUT=... -DROOT=... -DFILES=a|b -P embed_texts.cmake
string(REPLACE "|" ";" FILES "${FILES}")
set(text "// Made by scripts/embed_texts.cmake from the files it names.\n#include \"limn/gpu/shader_texts.h\"\n\n")
string(APPEND text "namespace limn::gpu {\nnamespace {\n\nstruct File {\n    std::string_view path, text;\n};\n\nconstexpr File files[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${file} content)
  file(RELATIVE_PATH path ${ROOT} ${file})
  string(APPEND text "    {\"${path}\", R\"glsl(${content})glsl\"},\n")
endforeach()
string(APPEND text "};\n\n} // namespace\n\nstd::optional<std::string_view> shader_text(std::string_view path)\n{\n")
string(APPEND text "    for (const File& file : files)\n        if (file.path == path)\n            return file.text;\n    return std::nullopt;\n}\n\n} // namespace limn::gpu\n")
file(WRITE ${OUTPUT} "${text}")

# mms_viewer_page(TARGET): compiles the files of viewer/dist into the program, which then needs neither
# Node nor a data folder.
function(mms_viewer_page target)
  set(page ${PROJECT_SOURCE_DIR}/viewer/dist)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS ${page}/*)
  list(SORT files)
  set(symbols "")
  set(declarations "")
  set(entries "")
  set(number 0)
  foreach(file IN LISTS files)
    file(RELATIVE_PATH name ${page} ${file})
    string(APPEND symbols
      "asm(\".section .rodata\\n.global mms_page_${number}\\nmms_page_${number}:\\n\"\n"
      "    \".incbin \\\"${file}\\\"\\n.global mms_page_${number}_end\\nmms_page_${number}_end:\\n\"\n"
      "    \".byte 0\\n.previous\\n\");\n")
    string(APPEND declarations
      "extern \"C\" const char mms_page_${number};\nextern \"C\" const char mms_page_${number}_end;\n")
    string(APPEND entries
      "      {\"/${name}\", {&mms_page_${number}, static_cast<std::size_t>(&mms_page_${number}_end - &mms_page_${number})}},\n")
    math(EXPR number "${number} + 1")
  endforeach()
  set(source ${PROJECT_BINARY_DIR}/viewer_page.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "#include <vector>

#include \"mms/server/http/page.hpp\"

@symbols@
@declarations@
namespace mms {

std::span<const PageFile> page_files() {
  static const std::vector<PageFile> kFiles = {
@entries@  };
  return kFiles;
}

}  // namespace mms
" @ONLY)
  # Unity builds ignore OBJECT_DEPENDS.
  set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${files}"
                                                   SKIP_UNITY_BUILD_INCLUSION ON)
  target_sources(${target} PRIVATE ${source})
endfunction()

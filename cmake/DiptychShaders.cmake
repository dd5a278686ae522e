# diptych_shaders(NAME FUNCTION function HEADER header FOLDER folder)
# A static library that holds the folder's shaders as SPIR-V, each under its file name:
#   #include "HEADER"; std::span<const uint32_t> diptych::core::FUNCTION(std::string_view name)
# Shaders are compiled anew when a file they include changes, and are optimised and validated before they are embedded:
# lavapipe compiles what spirv-opt has inlined and cleared in half the time, NVIDIA's driver in a third.
function(diptych_shaders name)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "FUNCTION;HEADER;FOLDER" "")
  find_program(DIPTYCH_GLSLANG glslangValidator REQUIRED)
  find_program(DIPTYCH_SPIRV_OPT spirv-opt REQUIRED)
  find_program(DIPTYCH_SPIRV_VAL spirv-val REQUIRED)

  set(mutant "")
  if(DIPTYCH_MUTANT AND NOT DIPTYCH_MUTANT STREQUAL "ALL")  # shaders have no environment to choose by
    set(mutant -DDIPTYCH_MUTANT -I${PROJECT_BINARY_DIR}/mutant)
  endif()

  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/${ARG_FOLDER})
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${name})
  file(MAKE_DIRECTORY ${output})
  file(GLOB shaders CONFIGURE_DEPENDS ${folder}/*.rgen ${folder}/*.rchit ${folder}/*.rahit ${folder}/*.rmiss
       ${folder}/*.comp ${folder}/*.vert ${folder}/*.frag)
  set(binaries "")
  set(embeddings "")
  set(entries "")
  foreach(shader IN LISTS shaders)
    cmake_path(GET shader FILENAME file)
    set(binary ${output}/${file}.spv)
    add_custom_command(
      OUTPUT ${binary}
      COMMAND ${DIPTYCH_GLSLANG} --quiet --target-env vulkan1.2 -I${PROJECT_SOURCE_DIR}/shared_glsl_cpp
              -I${PROJECT_SOURCE_DIR}/shaders ${mutant} --depfile ${binary}.d -o ${binary} ${shader}
      COMMAND ${DIPTYCH_SPIRV_OPT} -O --scalar-block-layout --target-env=vulkan1.2 ${binary} -o ${binary}
      COMMAND ${DIPTYCH_SPIRV_VAL} --scalar-block-layout --target-env vulkan1.2 ${binary}
      DEPENDS ${shader}
      DEPFILE ${binary}.d
      COMMENT "Compiling shader ${ARG_FOLDER}/${file}"
      VERBATIM)
    list(APPEND binaries ${binary})
    list(LENGTH binaries index)
    string(APPEND embeddings "EMBED(${index}, \"${binary}\")\n")
    string(APPEND entries "        {\"${file}\", begin_${index}, end_${index}},\n")
  endforeach()

  set(FUNCTION ${ARG_FUNCTION})
  set(HEADER ${ARG_HEADER})
  set(EMBEDDINGS "${embeddings}")
  set(ENTRIES "${entries}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/shader_binaries.h.in ${output}/${ARG_HEADER} @ONLY)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/shader_binaries.cpp.in ${output}/${ARG_FUNCTION}.cpp @ONLY)
  set_source_files_properties(${output}/${ARG_FUNCTION}.cpp PROPERTIES
    OBJECT_DEPENDS "${binaries}" SKIP_UNITY_BUILD_INCLUSION ON)  # a batch would not know what it depends on
  add_library(${name} STATIC ${output}/${ARG_FUNCTION}.cpp)
  target_include_directories(${name} PUBLIC ${output} PRIVATE ${PROJECT_SOURCE_DIR}/common)
  target_link_libraries(${name} PRIVATE diptych_options)
endfunction()

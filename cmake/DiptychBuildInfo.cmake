# diptych_build_info(NAME): an interface library with the header "build_info.h" (version, commit, modified, mutant). The
# header is looked at on every build and rewritten only when it changes, so an unchanged commit compiles nothing anew.
# Run as a script (cmake -P) with SOURCE, TEMPLATE, HEADER, VERSION and MUTANT, it writes that header.
if(CMAKE_SCRIPT_MODE_FILE)
  find_program(GIT git)
  set(COMMIT unknown)
  set(MODIFIED false)
  if(GIT)
    execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE head
                    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
    if(NOT failed)
      set(COMMIT ${head})
      execute_process(COMMAND ${GIT} -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes)
      if(changes)
        set(MODIFIED true)
      endif()
    endif()
  endif()
  configure_file(${TEMPLATE} ${HEADER} @ONLY)
  return()
endif()

function(diptych_build_info name)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${name})
  set(script
      ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DTEMPLATE=${PROJECT_SOURCE_DIR}/cmake/build_info.h.in
      -DHEADER=${folder}/build_info.h -DVERSION=${PROJECT_VERSION} -DMUTANT=${DIPTYCH_MUTANT}
      -P ${PROJECT_SOURCE_DIR}/cmake/DiptychBuildInfo.cmake)
  add_custom_target(${name}_header COMMAND ${script} BYPRODUCTS ${folder}/build_info.h VERBATIM)
  add_library(${name} INTERFACE)
  target_include_directories(${name} INTERFACE ${folder})
  add_dependencies(${name} ${name}_header)
endfunction()

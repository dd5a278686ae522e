# diptych_fonts(NAME)
# The faces of Roboto that the interface is set in, embedded, each under its file name:
#   #include "fonts.h"; std::string_view diptych::core::font_data(std::string_view name)
function(diptych_fonts name)
  set(files "")
  foreach(face Regular Medium)
    find_file(DIPTYCH_FONT_${face} Roboto-${face}.ttf
              PATHS /usr/share/fonts /usr/local/share/fonts
              PATH_SUFFIXES truetype/roboto/unhinted/RobotoTTF truetype/roboto/unhinted truetype/roboto google-roboto TTF roboto
              DOC "Roboto-${face}.ttf, as in Debian's package fonts-roboto-unhinted" REQUIRED)
    list(APPEND files ${DIPTYCH_FONT_${face}})
  endforeach()
  diptych_texts(${name} FUNCTION font_data HEADER fonts.h FILES ${files})
endfunction()

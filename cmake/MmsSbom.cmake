# Writes the SBOM mms.cdx.json (CycloneDX 1.5): the tables "In the program" and "In the viewer's
# page" of docs/dependencies.md, with the versions of the installed Debian packages and of
# viewer/package.json.
function(mms_write_sbom file)
  set(table ${PROJECT_SOURCE_DIR}/docs/dependencies.md)
  set(npm ${PROJECT_SOURCE_DIR}/viewer/package.json)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${table} ${npm})
  file(READ ${npm} viewer)
  find_program(dpkg_query dpkg-query)
  file(STRINGS ${table} lines)
  set(components "[]")
  set(count 0)
  foreach(line IN LISTS lines)
    if(line MATCHES "^## (.*)")
      set(section "${CMAKE_MATCH_1}")
    endif()
    if(section STREQUAL "For building and testing" OR
       NOT line MATCHES "^\\| ([a-z][a-z0-9+.-]+) \\| ([A-Za-z0-9. -]+) \\| (.*) \\|$")
      continue()
    endif()
    set(name ${CMAKE_MATCH_1})
    set(license ${CMAKE_MATCH_2})
    set(version "")
    if(section STREQUAL "In the viewer's page")
      string(JSON version GET "${viewer}" dependencies ${name})
      set(purl "pkg:npm/${name}@${version}")
    else()
      if(dpkg_query)
        execute_process(COMMAND ${dpkg_query} -W -f "\${Version}" ${name} OUTPUT_VARIABLE version
                        ERROR_QUIET)
      endif()
      if(version STREQUAL "")
        continue()  # an optional package that this build does not use
      endif()
      string(REPLACE ":" "%3A" version_in_url "${version}")
      string(REPLACE "+" "%2B" version_in_url "${version_in_url}")
      set(purl "pkg:deb/debian/${name}@${version_in_url}")
    endif()
    string(CONCAT component "{\"type\": \"library\", \"bom-ref\": \"${purl}\", "
           "\"name\": \"${name}\", \"version\": \"${version}\", \"purl\": \"${purl}\", "
           "\"licenses\": [{\"license\": {\"id\": \"${license}\"}}]}")
    string(JSON components SET "${components}" ${count} "${component}")
    math(EXPR count "${count} + 1")
  endforeach()
  string(CONCAT bom "{\"bomFormat\": \"CycloneDX\", \"specVersion\": \"1.5\", \"version\": 1, "
         "\"metadata\": {\"component\": {\"type\": \"application\", \"bom-ref\": \"mms\", "
         "\"name\": \"mms\", \"version\": \"${PROJECT_VERSION}\", "
         "\"licenses\": [{\"license\": {\"id\": \"BSD-3-Clause\"}}]}}}")
  string(JSON bom SET "${bom}" components "${components}")
  file(WRITE ${file} "${bom}\n")
endfunction()

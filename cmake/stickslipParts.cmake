# The optional parts of stickslip, each registered once. The library's own build reads this file, and the installed
# package does too: what a part needs is looked for on the machine that uses it.
cmake_policy(VERSION 3.22)

# stickslip_part(NAME HEADERS headers... ABOUT "what it needs, with its licence" DEBIAN "packages that bring it"
#                [PACKAGES "name version"... TARGETS targets...]  what find_package finds, and what of it is linked
#                [LIBRARY library FILE header])                   a library that has no package, and a header of it
set(stickslip_parts "")
macro(stickslip_part name)
  list(APPEND stickslip_parts ${name})
  cmake_parse_arguments(stickslip_part_${name} "" "ABOUT;DEBIAN;LIBRARY;FILE" "HEADERS;PACKAGES;TARGETS" ${ARGN})
endmacro()

stickslip_part(cholmod HEADERS linear_solver/cholmod.hpp ABOUT "SuiteSparse, LGPL/GPL" DEBIAN libsuitesparse-dev
               LIBRARY cholmod FILE suitesparse/cholmod.h)
stickslip_part(umfpack HEADERS linear_solver/umfpack.hpp ABOUT "SuiteSparse, GPL" DEBIAN libsuitesparse-dev
               LIBRARY umfpack FILE suitesparse/umfpack.h)
stickslip_part(banded HEADERS linear_solver/banded.hpp ABOUT "LAPACK, Boost.Graph" DEBIAN "liblapack-dev libboost-dev"
               PACKAGES LAPACK "Boost 1.74" TARGETS LAPACK::LAPACK Boost::headers)
stickslip_part(mumps HEADERS linear_solver/mumps.hpp ABOUT "sequential MUMPS, CeCILL-C" DEBIAN libmumps-seq-dev
               LIBRARY dmumps_seq FILE dmumps_c.h)
stickslip_part(tabulated HEADERS material/tabulated_hardening.hpp ABOUT "Boost.Math" DEBIAN libboost-dev
               PACKAGES "Boost 1.74" TARGETS Boost::headers)
stickslip_part(surfaces HEADERS contact/surface_contact.hpp ABOUT "Boost.Geometry" DEBIAN libboost-dev
               PACKAGES "Boost 1.74" TARGETS Boost::headers)
stickslip_part(triangulated HEADERS geometry/triangulated.hpp ABOUT "Boost.Geometry" DEBIAN libboost-dev
               PACKAGES "Boost 1.74" TARGETS Boost::headers)

# stickslip_add_part(NAME MISSING [IMPORTED]): finds what a part needs and adds stickslip::NAME, as an imported target of
# the installed package or as one of this build. MISSING is empty, or tells in a sentence why there is no such target.
function(stickslip_add_part name missing)
  set(${missing} "" PARENT_SCOPE)
  if(TARGET stickslip::${name})
    return()
  endif()
  if(NOT name IN_LIST stickslip_parts)
    list(JOIN stickslip_parts ", " parts)
    set(${missing} "stickslip has no part \"${name}\", only ${parts}." PARENT_SCOPE)
    return()
  endif()
  set(part stickslip_part_${name})
  set(lacking "")
  foreach(package IN LISTS ${part}_PACKAGES)
    separate_arguments(request UNIX_COMMAND "${package}")
    find_package(${request} QUIET)
    list(GET request 0 found)
    if(NOT ${found}_FOUND)
      list(APPEND lacking ${package})
    endif()
  endforeach()
  set(links ${${part}_TARGETS})
  if(${part}_LIBRARY)
    string(TOUPPER STICKSLIP_${name} prefix)
    find_library(${prefix}_LIBRARY ${${part}_LIBRARY})
    find_path(${prefix}_INCLUDE ${${part}_FILE})
    mark_as_advanced(${prefix}_LIBRARY ${prefix}_INCLUDE)
    if(NOT ${prefix}_LIBRARY)
      list(APPEND lacking "the library ${${part}_LIBRARY}")
    endif()
    if(NOT ${prefix}_INCLUDE)
      list(APPEND lacking "the header ${${part}_FILE}")
    endif()
    list(APPEND links ${${prefix}_LIBRARY})
  endif()
  if(lacking)
    list(JOIN lacking " and " lacking)
    set(${missing} "stickslip::${name} needs ${${part}_ABOUT}, but did not find ${lacking} (on Debian: ${${part}_DEBIAN})." PARENT_SCOPE)
    return()
  endif()

  if("IMPORTED" IN_LIST ARGN)
    set(target stickslip::${name})
    add_library(${target} INTERFACE IMPORTED)
  else()
    set(target stickslip_${name})
    add_library(${target} INTERFACE)
    add_library(stickslip::${name} ALIAS ${target})
  endif()
  target_link_libraries(${target} INTERFACE stickslip::stickslip ${links})
  if(${part}_FILE)
    target_include_directories(${target} SYSTEM INTERFACE ${${prefix}_INCLUDE})
  endif()
endfunction()

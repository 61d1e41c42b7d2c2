# shellcheck shell=bash
# The Debian mirror and its keyring, from the configuration of the host's apt.
# (`apt-get indextargets` would tell too, but only after an `apt-get update`, which fresh containers never had.)

# Sets mirror, empty where mmdebstrap is to choose, and keyrings as options of mmdebstrap.
find_mirror() {
    local keyring=- debian_keyring=/usr/share/keyrings/debian-archive-keyring.gpg
    mirror='' keyrings=()
    read -r mirror keyring < <(debian_sources_of_host /etc/apt /etc/os-release) || true
    if [[ $keyring == /* && -r $keyring ]]; then
        keyrings=("--keyring=$keyring")
    elif [[ -r $debian_keyring ]]; then
        keyrings=("--keyring=$debian_keyring")
    fi
}

# Prints "URI keyring" of the Debian archive as the host's apt uses it, one line per source; keyring may be "-".
# Both formats: one-line *.list and deb822 *.sources. Prints nothing on Ubuntu, which has another archive.
# Archives of others use the same suite and component names, so a source counts only if it is signed by Debian's
# keyring, or has the updates of the suite as well; in this order.
debian_sources_of_host() {
    local folder=$1 codename file files=()
    codename=$(
        # shellcheck disable=SC1090
        . "$2" 2>/dev/null && [[ ${ID:-} == debian ]] && printf '%s' "${VERSION_CODENAME:-sid}"
    ) || return 0
    for file in "$folder"/sources.list "$folder"/sources.list.d/*.list "$folder"/sources.list.d/*.sources; do
        if [[ -r $file ]]; then files+=("$file"); fi
    done
    ((${#files[@]})) || return 0
    awk -v codename="$codename" '
        BEGIN { split("stable testing unstable sid " codename, names); for (i in names) wanted[names[i]] = 1 }
        function source(uris, suites, components, types, keyring, enabled,   suite, uri, count, i, fits) {
            if (types !~ /(^| )deb( |$)/ || components !~ /(^| )main( |$)/ || enabled == "no") return
            if (keyring !~ /^\//) keyring = "-"
            fits = 0
            split(suites, suite, " "); for (i in suite) if (suite[i] in wanted) fits = 1
            count = split(uris, uri, " ")
            for (i = 1; i <= count; i++) {
                sub(/\/$/, "", uri[i])
                if (uri[i] !~ /^https?:/) continue
                if (suites ~ /-updates( |$)/) updated[uri[i]] = 1
                if (fits) { found++; address[found] = uri[i]; key[found] = keyring }
            }
        }
        function end_of_stanza() {
            source(field["uris"], field["suites"], field["components"], field["types"], field["signed-by"], field["enabled"])
            split("", field); name = ""
        }
        FNR == 1 { end_of_stanza(); deb822 = FILENAME ~ /\.sources$/ }
        /^[[:space:]]*#/ { next }
        deb822 && /^[[:space:]]*$/ { end_of_stanza(); next }
        deb822 && /^[A-Za-z-]+:/ {
            name = tolower(substr($0, 1, index($0, ":") - 1))
            value = substr($0, index($0, ":") + 1); gsub(/^[[:space:]]+|[[:space:]]+$/, "", value)
            field[name] = value; next
        }
        deb822 && name != "" { field[name] = field[name] " " $1; next }
        $1 == "deb" {
            line = $0; keyring = ""
            if (match(line, /\[[^]]*\]/)) {
                count = split(substr(line, RSTART + 1, RLENGTH - 2), option, " ")
                line = substr(line, 1, RSTART - 1) substr(line, RSTART + RLENGTH)
                for (i = 1; i <= count; i++) if (sub(/^signed-by=/, "", option[i])) keyring = option[i]
            }
            count = split(line, part, " "); components = ""
            for (i = 4; i <= count; i++) components = components " " part[i]
            source(part[2], part[3], components, "deb", keyring, "yes")
        }
        END {
            end_of_stanza()
            for (rank = 1; rank <= 2; rank++) for (i = 1; i <= found; i++) {
                signed = key[i] ~ /\/debian-archive/
                if (rank == (signed ? 1 : address[i] in updated ? 2 : 3)) print address[i], key[i]
            }
        }
    ' "${files[@]}"
}

# page_command NAME FILE: the fenced block after `<!-- command: NAME -->`.
page_command() {
    local text
    text=$(awk -v mark="<!-- command: $1 -->" '
        index($0, mark) { wanted = 1; next }
        wanted && /^```/ { if (inside) exit; inside = 1; next }
        wanted && inside { print }
    ' "$2")
    if [ -z "$text" ]; then
        echo "$2: no command block after '<!-- command: $1 -->'" >&2
        return 1
    fi
    printf '%s\n' "$text"
}

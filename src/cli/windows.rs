//! What only Windows tells: the memory that the process has had, and whether its console belongs to nobody else.

use winsafe::co::TH32CS;
use winsafe::{FreeConsole, GetCurrentProcessId, HPROCESS, HPROCESSLIST, SysResult};

/// The program that draws desktop and folders, and starts what is double-clicked there.
const DESKTOP: &str = "explorer.exe";

/// The largest working set of this process since its start, in bytes.
pub(super) fn peak_bytes() -> Option<usize> {
    let memory = HPROCESS::GetCurrentProcess().GetProcessMemoryInfo().ok()?;
    Some(memory.PeakWorkingSetSize)
}

/// Closes the console that Windows opened for a program started from the desktop; one in which somebody typed a command stays.
/// Errors change nothing: the console then stands behind the window.
pub(super) fn leave_console_of_desktop() {
    if is_child_of_desktop().unwrap_or(false) {
        let _ = FreeConsole();
    }
}

/// Whether the process that started this one is the desktop.
fn is_child_of_desktop() -> SysResult<bool> {
    let mut list = HPROCESSLIST::CreateToolhelp32Snapshot(TH32CS::SNAPPROCESS, None)?;
    let mut processes = Vec::new();
    for process in list.iter_processes() {
        let process = process?;
        processes.push((process.th32ProcessID, process.th32ParentProcessID, process.szExeFile()));
    }
    let named = |id: u32| processes.iter().find(|(process, ..)| *process == id);
    let parent = named(GetCurrentProcessId()).and_then(|(_, parent, _)| named(*parent));
    Ok(parent.is_some_and(|(.., name)| name.eq_ignore_ascii_case(DESKTOP)))
}

% Tracks a measured table with the command line and reads estimates and errors into MATLAB or GNU Octave.
%   octave --no-gui track.m ROBOT.yaml TABLE.csv
%   matlab -batch "robot = 'ROBOT.yaml'; table = 'TABLE.csv'; track"
if exist('OCTAVE_VERSION', 'builtin')
  arguments = argv();
  robot = arguments{1};
  table = arguments{2};
end
cli = getenv('CAPSTAN_CLI');
if isempty(cli), cli = 'capstan-cli'; end
estimates = [tempname() '.csv'];
report = [tempname() '.json'];
[status, words] = system(sprintf('"%s" track "%s" --robot "%s" --out "%s" --json "%s" 2>&1', ...
                                 cli, table, robot, estimates, report));
if status ~= 0, error('%s', words); end  % the message names file, line, value and remedy

found = jsondecode(fileread(report));
file = fopen(estimates);
names = strsplit(strtrim(fgetl(file)), ',');
formats = repmat({'%f'}, size(names));
formats{strcmp(names, 'gate')} = '%s';  % the only column with text
columns = textscan(file, strjoin(formats, ''), 'Delimiter', ',', 'EmptyValue', NaN);
fclose(file);
q = @(joint) columns{strcmp(names, sprintf('q_ukf%d', joint))};
fprintf('%d rows, joint 1 from %.4f to %.4f rad\n', numel(q(1)), min(q(1)), max(q(1)));
fprintf('RMS kinematics %.6g %.6g %.6g, UKF %.6g %.6g %.6g (rad, rad, m)\n', found.rms.kin, found.rms.ukf);
delete(estimates);
delete(report);
